#include "services/ekf_svc/core/noise_monitor.h"

#include <algorithm>

#include "services/ekf_svc/core/chi_square.h"

namespace roomwise::ekf {
namespace {

constexpr int kWindowDof = 100;  // some seconds of driving
constexpr double kRatioMax = 4.0;

}  // namespace

void NoiseMonitor::record(const InnovationStatistics& innovation) {
  squared_ += innovation.squared;
  degrees_of_freedom_ += innovation.degrees_of_freedom;
  if (degrees_of_freedom_ < kWindowDof) return;
  const double mean = squared_ / degrees_of_freedom_;
  const double high = chi_square_quantile(degrees_of_freedom_, kNormal975) / degrees_of_freedom_;
  if (mean > high || mean < 1.0) ratio_ = std::clamp(ratio_ * mean, 1.0, kRatioMax);
  squared_ = 0.0;
  degrees_of_freedom_ = 0;
}

}  // namespace roomwise::ekf
