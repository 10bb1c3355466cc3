#include "services/ekf_svc/core/odometry_timeline.h"

#include <stdexcept>

namespace roomwise::ekf {

void OdometryTimeline::restart(Time start) {
  start_ = end_ = start;
  first_ = count_ = 0;
}

void OdometryTimeline::append(Time end, const MotionStep& step) {
  if (is_full() || end <= end_) throw std::logic_error("odometry timeline: full, or time stands");
  ++count_;
  at(count_ - 1) = {end, step};
  end_ = end;
}

MotionIncrement OdometryTimeline::take(Time until, const OdometryCalibration& calibration) {
  if (until < start_ || until > end_) throw std::logic_error("odometry timeline: outside");
  MotionIncrement motion;
  while (count_ > 0 && at(0).end <= until) {
    motion.append(at(0).step, calibration);
    drop_first();
  }
  if (until > start_) {
    Piece& piece = at(0);
    const double ratio = seconds(until - start_) / seconds(piece.end - start_);
    motion.append(part_of(piece.step, ratio), calibration);
    piece.step = part_of(piece.step, 1.0 - ratio);
    start_ = until;
  }
  return motion;
}

MotionIncrement OdometryTimeline::ahead(const OdometryCalibration& calibration) const {
  MotionIncrement motion;
  for (std::size_t i = 0; i < count_; ++i) motion.append(at(i).step, calibration);
  return motion;
}

void OdometryTimeline::drop_first() {
  start_ = at(0).end;
  first_ = (first_ + 1) % kStepsMax;
  --count_;
}

}  // namespace roomwise::ekf
