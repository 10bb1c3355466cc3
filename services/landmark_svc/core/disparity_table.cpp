#include "services/landmark_svc/core/disparity_table.h"

#include <algorithm>
#include <cmath>

namespace roomwise::landmark {

void DisparityTable::prepare(double unit_m, double quanta_m) {
  if (unit_m == unit_m_ && quanta_m == quanta_m_) return;
  unit_m_ = unit_m;
  quanta_m_ = quanta_m;
  constexpr double kLastStep = 65534.0;  // 0xFFFF is never a reading
  constexpr double kRounding = 1e-9;     // 4095 steps of 0.001 m are not beyond 4.095 m
  smallest_good_step_ = static_cast<int>(
      std::ceil(std::min(std::max(kDepthMin_m / unit_m * (1.0 - kRounding), 1.0), kLastStep + 1)));
  largest_good_step_ =
      static_cast<int>(std::min(kDepthMax_m / unit_m * (1.0 + kRounding), kLastStep));
  largest_beyond_step_ = static_cast<int>(std::min(kBeyondMax_m / unit_m, kLastStep));
  parts_.assign(65536, 0);
  for (int step = smallest_good_step_; step <= largest_good_step_; ++step) {
    const double parts = std::round(kPartsPerQuantum * quanta_m / (step * unit_m));
    parts_[static_cast<std::size_t>(step)] =
        static_cast<std::uint16_t>(std::clamp(parts, 1.0, 65535.0));
  }
}

std::uint16_t DisparityTable::steps_from_m(double length_m) const {
  const double steps = std::ceil(length_m / unit_m_ * (1.0 - 1e-9));
  return static_cast<std::uint16_t>(std::clamp(steps, 1.0, 65535.0));
}

}  // namespace roomwise::landmark
