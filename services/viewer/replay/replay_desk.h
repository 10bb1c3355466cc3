#pragma once
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "services/viewer/replay/log_player.h"

namespace roomwise::viewer {

/// What one client asks of logs: "open NAME", "live", "play", "pause", "step", "seek SECONDS",
/// "speed RATIO".
class ReplayDesk {
 public:
  using Clock = std::chrono::steady_clock;

  ReplayDesk(std::filesystem::path folder, LogPlayer::Sink sink);

  /// Why the order cannot be followed; empty: it was.
  std::string follow(std::string_view order, Clock::time_point now);

  /// Hands out what is due.
  void play(Clock::time_point now);

  bool is_replay() const { return player_.has_value(); }
  bool is_playing() const { return is_replay() && playing_; }

  /// For the page, as JSON members: "mode":"replay","log":...
  std::string status() const;

 private:
  std::string open(std::string_view name);
  std::string follow_in_replay(std::string_view verb, std::string_view rest);
  void start_counting(Clock::time_point now);

  std::filesystem::path folder_;
  LogPlayer::Sink sink_;
  std::optional<LogPlayer> player_;
  std::string name_;
  bool playing_ = false;
  double speed_ratio_ = 1.0;
  Clock::time_point counted_from_;  ///< when the log stood at position_from_s_
  double position_from_s_ = 0.0;
};

/// `text` in quotes, as JSON has it.
std::string json_text(std::string_view text);

}  // namespace roomwise::viewer
