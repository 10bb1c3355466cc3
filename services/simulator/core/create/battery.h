#pragma once
#include "services/simulator/core/create/body_readings.h"

namespace roomwise::simulator {

/// Nickel-metal pack of the Create: charge by counting, voltage falling with it.
class Battery {
 public:
  /// `charge_ratio` in [0, 1].
  explicit Battery(double charge_ratio) { set_charge(charge_ratio); }

  void set_charge(double charge_ratio) { charge_mah_ = charge_ratio * kCapacity_mah; }

  /// Draws for `dt_s` what the wheels take and the electronics, or charges.
  void step(double wheels_ma, bool charges, double dt_s);

  /// Writes voltage, current, charge, capacity and charging state.
  void report(BodyReadings& readings) const;

 private:
  static constexpr double kCapacity_mah = 2696.0;
  double charge_mah_ = kCapacity_mah;
  double current_ma_ = 0.0;  ///< positive charges
  bool charges_ = false;
};

}  // namespace roomwise::simulator
