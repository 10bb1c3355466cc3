#include "services/ekf_svc/core/sighting.h"

#include <cmath>

namespace roomwise::ekf {
namespace {

constexpr double kRangeMax_m = 100.0;
constexpr double kBearingMax_rad = 7.0;  // a turn and rounding
constexpr double kRangeVarianceMax_m2 = 1e4;
constexpr double kBearingVarianceMax_rad2 = 10.0;

bool is_finite(const PolarObservation& polar) {
  return std::isfinite(polar.range_m) && std::isfinite(polar.bearing_rad) &&
         polar.covariance.allFinite();
}

bool is_sighting_covariance(const Eigen::Matrix2d& covariance) {
  const double range = covariance(0, 0);
  const double bearing = covariance(1, 1);
  return range > 0.0 && bearing > 0.0 && range <= kRangeVarianceMax_m2 &&
         bearing <= kBearingVarianceMax_rad2 &&
         covariance(0, 1) * covariance(0, 1) < range * bearing;
}

}  // namespace

Verdict check(const Sighting& sighting) {
  const PolarObservation& polar = sighting.polar;
  if (!is_finite(polar)) return Verdict::kNotFinite;
  if (!(polar.range_m > 0.0) || polar.range_m > kRangeMax_m) return Verdict::kRangeInvalid;
  if (std::abs(polar.bearing_rad) > kBearingMax_rad) return Verdict::kBearingInvalid;
  if (!is_sighting_covariance(polar.covariance)) return Verdict::kCovarianceInvalid;
  if (sighting.moving) return Verdict::kMoving;
  return Verdict::kMatched;
}

}  // namespace roomwise::ekf
