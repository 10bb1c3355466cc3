#pragma once
#include <cstdint>

#include "services/safety_svc/core/instant.h"

namespace roomwise::safety {

enum class ResetResult : std::uint8_t {
  kReset,
  kNotLatched,
  kOtherLatch,  ///< the reset means another stop than the one in force
  kStillHeld,
  kNotCalm,  ///< somebody asks for motion, or the robot moves or is pressed
};

/// An emergency stop stays until a person resets this very one.
class EstopLatch {
 public:
  /// Pressed, or still held.
  void press(const Instant& now, bool is_held);

  /// `is_calm`: nobody asks for motion, the robot stands and nothing presses it.
  [[nodiscard]] ResetResult reset(const Instant& now, std::int64_t latch_id, bool is_calm);

  bool is_latched() const { return latch_id_ != 0; }
  /// Of the stop in force, positive and never used before; 0: none.
  std::int64_t latch_id() const { return latch_id_; }

 private:
  std::int64_t latch_id_ = 0;
  std::int64_t last_id_ = 0;
  Duration held_until_ = Duration::min();
};

}  // namespace roomwise::safety
