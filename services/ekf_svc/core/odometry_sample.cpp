#include "services/ekf_svc/core/odometry_sample.h"

#include <cmath>

namespace roomwise::ekf {
namespace {

constexpr std::int64_t kUtimeMax = 4'000'000'000'000'000'000;  // differences still fit
constexpr Duration kIntervalMax = std::chrono::seconds(60);
constexpr double kSpeedMax_mps = 5.0;
constexpr double kTurnRateMax_radps = 30.0;
constexpr double kSlackTime_s = 0.05;  // intervals are measured, and by several clocks
constexpr double kDistanceVarianceMax_m2 = 100.0;
constexpr double kTurnVarianceMax_rad2 = 100.0;

bool is_finite(const OdometrySample& sample) {
  return std::isfinite(sample.distance_m) && std::isfinite(sample.turn_rad) &&
         sample.covariance.allFinite();
}

bool is_too_fast(const OdometrySample& sample) {
  const double time_s = seconds(sample.interval) + kSlackTime_s;
  return std::abs(sample.distance_m) > kSpeedMax_mps * time_s ||
         std::abs(sample.turn_rad) > kTurnRateMax_radps * time_s;
}

bool is_covariance(const Eigen::Matrix2d& covariance) {
  const double distance = covariance(0, 0);
  const double turn = covariance(1, 1);
  constexpr double kRounding = 1.0 + 1e-9;  // a rank-1 covariance is welcome
  return distance >= 0.0 && turn >= 0.0 && distance <= kDistanceVarianceMax_m2 &&
         turn <= kTurnVarianceMax_rad2 &&
         covariance(0, 1) * covariance(0, 1) <= kRounding * distance * turn;
}

}  // namespace

OdometryVerdict check(const OdometrySample& sample) {
  const std::int64_t utime = utime_of(sample.time);
  const bool time_is_valid = utime > 0 && utime < kUtimeMax && sample.interval > Duration(0) &&
                             sample.interval <= kIntervalMax;
  if (!time_is_valid) return OdometryVerdict::kTimeInvalid;
  if (!is_finite(sample)) return OdometryVerdict::kNotFinite;
  if (is_too_fast(sample)) return OdometryVerdict::kTooFast;
  return is_covariance(sample.covariance) ? OdometryVerdict::kUsed
                                          : OdometryVerdict::kCovarianceInvalid;
}

}  // namespace roomwise::ekf
