#pragma once
#include <span>

namespace roomwise::ekf {

/// Range to the nearest surface per bearing, as a depth image shows it. Empty: nothing is known.
struct VirtualScan {
  double first_bearing_rad = 0.0;  ///< of beam 0, counter-clockwise from robot x
  double bearing_step_rad = 0.0;   ///< > 0
  std::span<const float> range_m;  ///< per beam; NaN or <= 0: not measured
};

}  // namespace roomwise::ekf
