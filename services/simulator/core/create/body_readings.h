#pragma once
#include <array>
#include <cstdint>

#include "services/simulator/core/left_right.h"

namespace roomwise::simulator {

/// What the Create's sensors read at one instant, in the units of the Open Interface: its input
/// from the body. Arrays run from left to right.
struct BodyReadings {
  LeftRight<bool> bump;
  LeftRight<bool> wheel_drop;
  bool caster_drop = false;  ///< Create 1 only
  bool wall = false;
  bool virtual_wall = false;
  std::array<bool, 4> cliff{};  ///< left, front left, front right, right
  std::array<std::uint16_t, 4> cliff_signal{};
  std::uint16_t wall_signal = 0;
  std::array<std::uint16_t, 6> light_signal{};  ///< left, front left, centre left, and mirrored
  LeftRight<bool> overcurrent;
  LeftRight<std::int16_t> wheel_current_ma;
  LeftRight<std::uint16_t> encoder_ticks;
  LeftRight<double> turned_m;  ///< way of each wheel since the start: what distance and angle count
  std::uint8_t buttons = 0;
  std::uint8_t charging_state =
      0;                          ///< 0 none, 1 recondition, 2 full, 3 trickle, 4 waiting, 5 fault
  bool internal_charger = false;  ///< plugged and powered
  bool home_base = false;         ///< on it, and it is powered
  std::uint16_t voltage_mv = 0;
  std::int16_t current_ma = 0;  ///< negative discharges
  std::int8_t temperature_c = 25;
  std::uint16_t charge_mah = 0;
  std::uint16_t capacity_mah = 0;

  bool any_cliff() const { return cliff[0] || cliff[1] || cliff[2] || cliff[3]; }
  bool any_wheel_drop() const { return wheel_drop.left || wheel_drop.right || caster_drop; }
  bool on_charger() const { return internal_charger || home_base; }
};

}  // namespace roomwise::simulator
