#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "common/bus/log_file.h"

namespace roomwise::viewer {

/// Names of the logs in `folder` and the folders right below it, sorted; a name is a path in it.
std::vector<std::string> log_names(const std::filesystem::path& folder);

/// Plays a log to one client: forwards from any moment, at any speed, or a camera frame at a time.
/// It knows no bus, so nothing it plays can get there.
class LogPlayer {
 public:
  using Sink = std::function<void(const LogEvent&)>;

  /// Throws std::runtime_error if the log cannot be read or holds nothing.
  LogPlayer(const std::filesystem::path& path, Sink sink);

  /// Where the log stands, and how long it is, in seconds from its first event.
  double position_s() const { return position_s_; }
  double length_s() const;
  bool at_end() const { return next_ == index_.size(); }

  /// Hands out everything up to `position_s`, which must not go back.
  void advance_to(double position_s);

  /// Hands out the newest message of each channel as it was then, and goes on from there.
  void seek(double position_s);

  /// To the next KINECT_FRAME, or the end.
  void step();

 private:
  struct Entry {
    Time time;
    std::uint64_t byte;
    std::uint16_t channel;
  };
  std::uint16_t number_of(const std::string& channel);
  double seconds_at(std::size_t entry) const;
  void hand_out(std::size_t entry);

  LogReader reader_;
  Sink sink_;
  std::vector<std::string> channels_;
  std::vector<Entry> index_;
  std::size_t next_ = 0;  ///< entry not handed out yet
  double position_s_ = 0.0;
  LogEvent event_;
};

}  // namespace roomwise::viewer
