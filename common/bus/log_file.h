#pragma once
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/log_event.h"

namespace roomwise {

/// Bytes of a log that are not a whole event: [first_byte, resumed_byte).
struct LogDamage {
  std::uint64_t first_byte = 0;
  std::uint64_t resumed_byte = 0;  ///< where the next whole event starts, or the end of the file
};

/// Reads an LCM event log (lcm-logger's format: LCM 1.3.1, eventlog.c). After damage it goes on at
/// the next place where a whole event starts, and remembers what it passed over.
class LogReader {
 public:
  /// Throws std::runtime_error naming the file if it cannot be opened.
  explicit LogReader(const std::filesystem::path& path);

  /// Reads the next whole event into `event`, reusing its memory; false at the end.
  bool next(LogEvent& event);

  std::uint64_t size_bytes() const { return size_bytes_; }
  std::uint64_t position_bytes() const { return position_bytes_; }
  const std::vector<LogDamage>& damage() const { return damage_; }

  /// "run.lcmlog: damaged at byte 99984, 56 bytes passed over", a line each; empty if none.
  std::string damage_report() const;

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  bool read_event_at(std::uint64_t byte, LogEvent& event);
  std::uint64_t find_event_after(std::uint64_t byte, LogEvent& event);

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  std::uint64_t size_bytes_ = 0;
  std::uint64_t position_bytes_ = 0;
  std::uint64_t file_position_bytes_ = 0;
  std::vector<LogDamage> damage_;
};

/// Writes an LCM event log that lcm-logplayer and LogReader read.
class LogWriter {
 public:
  /// Throws std::runtime_error naming the file if it cannot be made.
  explicit LogWriter(const std::filesystem::path& path);

  /// Throws std::runtime_error naming the file if the disk is full or gone.
  void write(const LogEvent& event);

  /// Encodes and writes one message at `time`; `message.seq` is the caller's business.
  template <class ChannelType, class Message>
  void write(const ChannelType& channel, Time time, const Message& message);

  /// Flushes; throws as write(). The destructor flushes too but cannot say that it failed.
  void close();

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::filesystem::path path_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  std::int64_t event_number_ = 0;
  LogEvent event_;
};

}  // namespace roomwise

#include "common/bus/wire.h"

namespace roomwise {

template <class ChannelType, class Message>
void LogWriter::write(const ChannelType& channel, Time time, const Message& message) {
  event_.time = time;
  event_.channel = channel.name;
  encode(message, event_.data);
  write(event_);
}

}  // namespace roomwise
