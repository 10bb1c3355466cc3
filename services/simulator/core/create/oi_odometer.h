#pragma once
#include <cstdint>

#include "services/simulator/core/left_right.h"

namespace roomwise::simulator {

/// Packets 19 and 20: whole millimetres and degrees since the last read, each reset by reading it.
class OiOdometer {
 public:
  struct Setup {
    double wheel_base_m = 0.235;
    bool carries = false;         ///< fractions are kept for the next read, not forgotten
    double distance_ratio = 1.0;  ///< what old firmware makes of a millimetre
    double angle_ratio = 1.0;     ///< and of a degree
  };
  explicit OiOdometer(const Setup& setup) : setup_(setup) {}

  /// Counts from here.
  void start_at(const LeftRight<double>& turned_m) { last_m_ = turned_m; }

  /// Ways of both wheels since the start.
  void sample(const LeftRight<double>& turned_m);

  /// Capped to 16 bits.
  std::int16_t take_distance_mm();
  std::int16_t take_angle_deg();

 private:
  std::int16_t take(double& gathered) const;

  Setup setup_;
  LeftRight<double> last_m_;
  double distance_mm_ = 0.0;
  double angle_deg_ = 0.0;
};

}  // namespace roomwise::simulator
