#pragma once
#include <cstddef>
#include <vector>

#include "common/time.h"
#include "services/ekf_svc/core/motion.h"

namespace roomwise::ekf {

/// Motion that odometry has reported and the filter has not used yet, so that a frame which comes
/// late is used at the instant it was taken. Between two reports the motion is a constant twist.
/// Memory is taken at construction.
class OdometryTimeline {
 public:
  /// Forgets everything; the motion that follows begins at `start`.
  void restart(Time start);

  /// Appends the motion from end() to `end` (which is later). Throws std::logic_error when full.
  void append(Time end, const MotionStep& step);

  /// Takes away the motion from start() to `until`, which is then the new start().
  /// start() <= until <= end(), else std::logic_error.
  MotionIncrement take(Time until, const OdometryCalibration& calibration = {});

  /// All the motion from start() to end().
  MotionIncrement ahead(const OdometryCalibration& calibration = {}) const;

  Time start() const { return start_; }
  Time end() const { return end_; }
  bool is_full() const { return count_ == kStepsMax; }
  /// End of the oldest step.
  Time first_end() const { return at(0).end; }

 private:
  static constexpr std::size_t kStepsMax = 512;
  struct Piece {
    Time end{};
    MotionStep step;
  };
  Piece& at(std::size_t i) { return pieces_[(first_ + i) % kStepsMax]; }
  const Piece& at(std::size_t i) const { return pieces_[(first_ + i) % kStepsMax]; }
  void drop_first();

  std::vector<Piece> pieces_{kStepsMax};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  Time start_{};
  Time end_{};
};

}  // namespace roomwise::ekf
