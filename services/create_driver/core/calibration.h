#pragma once
#include <cstdint>
#include <optional>

#include "common/create/encoder_odometry.h"

namespace roomwise::create {

/// Ticks both wheels turned in a run, added up.
struct WheelTicks {
  std::int64_t left = 0;
  std::int64_t right = 0;
};

/// A drive straight ahead, and where it led by the tape measure, from where the robot stood.
struct StraightRun {
  WheelTicks ticks;
  double forward_m = 0.0;
  double left_m = 0.0;
};

/// A turn on the spot, and by how much the robot turned in truth, counter-clockwise positive.
struct SpinRun {
  WheelTicks ticks;
  double turn_rad = 0.0;
};

/// The wheels' measures that explain both runs exactly; the noise is left as in `geometry`. Nothing
/// if no Create is like that: a base off by more than 20 % from that of `geometry`, a diameter by
/// more than 10 %, or a wheel by more than 10 % from the other.
///
/// With metres per tick a_l, a_r and base b: a straight run is an arc of length s and turn h, so
///   a_l n_l = s - h b / 2,  a_r n_r = s + h b / 2,  and the spin by H is  a_r m_r - a_l m_l = H b;
/// eliminating a_l and a_r:
///   b = s (m_r / n_r - m_l / n_l) / (H - h / 2 (m_r / n_r + m_l / n_l)).
std::optional<WheelGeometry> calibrated(const WheelGeometry& geometry, const StraightRun& straight,
                                        const SpinRun& spin);

}  // namespace roomwise::create
