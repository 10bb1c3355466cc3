#include "services/simulator/core/path_profile.h"

#include <algorithm>
#include <cmath>

namespace roomwise::simulator {
namespace {

double square(double x) { return x * x; }

}  // namespace

SpeedProfile::SpeedProfile(double way, double first, double last, Bounds bounds)
    : way_(way), first_(first), last_(last), acceleration_(bounds.acceleration) {
  const double reachable = std::sqrt(acceleration_ * way + (square(first) + square(last)) / 2.0);
  peak_ = std::max({std::min(bounds.speed, reachable), first, last});
  up_s_ = (peak_ - first) / acceleration_;
  down_s_ = (peak_ - last) / acceleration_;
  const double changing =
      (2.0 * square(peak_) - square(first) - square(last)) / 2.0 / acceleration_;
  hold_s_ = peak_ > 0.0 ? std::max(0.0, way - changing) / peak_ : 0.0;
}

SpeedProfile::Moment SpeedProfile::at(double t_s) const {
  if (t_s >= duration_s()) return {way_, last_};
  if (t_s >= down_from_s()) {  // counted back from the end, so that it arrives exactly
    const double left_s = duration_s() - t_s;
    return {way_ - last_ * left_s - acceleration_ * square(left_s) / 2.0,
            last_ + acceleration_ * left_s};
  }
  const double up_way = first_ * up_s_ + acceleration_ * square(up_s_) / 2.0;
  if (t_s >= up_s_) return {up_way + peak_ * (t_s - up_s_), peak_};
  const double gone_s = std::max(0.0, t_s);
  return {first_ * gone_s + acceleration_ * square(gone_s) / 2.0, first_ + acceleration_ * gone_s};
}

}  // namespace roomwise::simulator
