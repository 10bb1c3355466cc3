#pragma once
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "common/bus/log_event.h"
#include "common/bus/mapped_file.h"
#include "common/bus/wire.h"

namespace roomwise {

/// Bytes of a log that are not a whole event: [first_byte, resumed_byte).
struct LogDamage {
  std::uint64_t first_byte = 0;
  std::uint64_t resumed_byte = 0;  ///< where the next whole event starts, or the end of the file
};

/// Reads an LCM event log. After damage it goes on where the next whole event starts, and remembers
/// what it passed over.
///
/// Format (LCM 1.3.1, eventlog.c), big-endian: sync word 0xEDA1DA01, int64 event number, int64 time
/// [us], int32 channel length, int32 data length, channel, data.
class LogReader {
 public:
  /// Throws std::runtime_error naming the file if it cannot be read.
  explicit LogReader(const std::filesystem::path& path);

  /// Reads the next whole event into `event`, reusing its memory; false at the end.
  bool next(LogEvent& event);

  std::uint64_t size_bytes() const { return file_.bytes().size(); }
  std::uint64_t position_bytes() const { return position_; }
  /// The next event read is the one that starts at `byte`, as position_bytes() said before reading
  /// it.
  void go_to(std::uint64_t byte) { position_ = byte; }
  const std::vector<LogDamage>& damage() const { return damage_; }

  /// "run.lcmlog: damaged at byte 99984: 56 bytes passed over", a line for each; empty if none.
  std::string damage_report() const;

 private:
  std::uint64_t event_size_at(std::uint64_t byte) const;
  std::uint64_t find_event(std::uint64_t byte) const;
  bool starts_event(std::uint64_t byte) const { return event_size_at(byte) > 0; }
  std::uint64_t whole_event_at(std::uint64_t byte) const;
  void pass_over_damage();

  std::filesystem::path path_;
  MappedFile file_;
  std::uint64_t position_ = 0;
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
  template <class Channel, class Message>
  void write(const Channel& channel, Time time, const Message& message) {
    event_.time = time;
    event_.channel = channel.name;
    encode(message, event_.data);
    write(event_);
  }

  /// Flushes; throws as write(). The destructor flushes too but cannot say that it failed.
  void close();

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  [[noreturn]] void refuse() const;

  std::filesystem::path path_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  std::int64_t event_number_ = 0;
  LogEvent event_;
};

}  // namespace roomwise
