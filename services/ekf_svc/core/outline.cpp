#include "services/ekf_svc/core/outline.h"

#include <cmath>

#include "common/geometry/angle.h"

namespace roomwise::ekf {
namespace {

constexpr double kRepeatSigma_m = 0.03;
constexpr double kDriftSigma_ratio = 0.1;  // of the way since
constexpr double kRemembered_m = 2.0;      // of way

}  // namespace

RangeOff range_off(const Residual& chord, const BodyObservation& seen, double travel_m) {
  return {seen.p_robot_m.norm() - (seen.p_robot_m - chord.innovation).norm(), travel_m};
}

bool repeats(const RangeOff& before, const RangeOff& now) {
  const double way_m = now.travel_m - before.travel_m;
  if (!(way_m < kRemembered_m)) return true;
  const double sigma_m = std::hypot(kRepeatSigma_m, kDriftSigma_ratio * way_m);
  return std::abs(now.off_m - before.off_m) <= 3.0 * sigma_m;
}

bool may_be(const Landmark& landmark, const RangeOff& now) {
  return !is_outline(landmark.kind) || repeats(landmark.range_off, now);
}

Eigen::Matrix2d turned_softening(double turned_rad, double shift_m_per_rad) {
  if (!std::isfinite(turned_rad)) return Eigen::Matrix2d::Zero();
  const double shift_m = shift_m_per_rad * wrap_angle(turned_rad);
  return shift_m * shift_m * Eigen::Matrix2d::Identity();
}

}  // namespace roomwise::ekf
