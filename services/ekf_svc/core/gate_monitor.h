#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace roomwise::ekf {

/// Watches what a gate refuses of landmarks whose identity is certain. When the state is right, one
/// in a hundred is refused, and a misread landmark is refused alone. When the robot was pushed or
/// its wheels slipped, most of what is seen is refused, whichever landmark it is of: then it is the
/// pose that is wrong, and a filter that trusts its gate would stay locked out for ever.
class GateMonitor {
 public:
  void record(std::int64_t map_id, bool accepted);

  /// Of the last kWindow answers (at least kEvidence) most were refusals, of two landmarks or more.
  bool pose_is_doubtful() const;

  /// The window is full, and most of it acceptances.
  bool is_healthy() const { return count_ == kWindow && !pose_is_doubtful(); }

  /// Most answers about other landmarks were acceptances: if this one is refused, it is wrong.
  bool others_are_accepted(std::int64_t map_id) const;

  /// Forgets the answers, after something was done about them.
  void clear() { count_ = next_ = 0; }

 private:
  static constexpr std::size_t kWindow = 12;
  static constexpr std::size_t kEvidence = 4;
  struct Answer {
    std::int64_t map_id = 0;
    bool accepted = false;
  };
  std::array<Answer, kWindow> answers_;
  std::size_t next_ = 0;
  std::size_t count_ = 0;
};

}  // namespace roomwise::ekf
