#include "services/simulator/core/create/battery.h"

#include <algorithm>
#include <cmath>

namespace roomwise::simulator {
namespace {

constexpr double kElectronics_ma = 150.0;
constexpr double kFullCharging_ma = 1250.0;
constexpr double kTrickle_ma = 60.0;
constexpr double kEmpty_mv = 13200.0;
constexpr double kFull_mv = 16400.0;
constexpr double kResistance_ohm = 0.25;

constexpr std::uint8_t kNotCharging = 0;
constexpr std::uint8_t kFullCharging = 2;
constexpr std::uint8_t kTrickleCharging = 3;

}  // namespace

void Battery::step(double wheels_ma, bool charges, double dt_s) {
  const bool is_full = charge_mah_ >= kCapacity_mah;
  const double charging_ma = is_full ? kTrickle_ma : kFullCharging_ma;
  charges_ = charges;
  current_ma_ = charges ? charging_ma : -kElectronics_ma - wheels_ma;
  charge_mah_ = std::clamp(charge_mah_ + current_ma_ * dt_s / 3600.0, 0.0, kCapacity_mah);
}

void Battery::report(BodyReadings& readings) const {
  const double full_ratio = charge_mah_ / kCapacity_mah;
  const double voltage_mv =
      kEmpty_mv + full_ratio * (kFull_mv - kEmpty_mv) + current_ma_ * kResistance_ohm;
  const std::uint8_t charging = full_ratio >= 1.0 ? kTrickleCharging : kFullCharging;
  readings.charging_state = charges_ ? charging : kNotCharging;
  readings.voltage_mv = static_cast<std::uint16_t>(std::lround(voltage_mv));
  readings.current_ma = static_cast<std::int16_t>(std::lround(current_ma_));
  readings.charge_mah = static_cast<std::uint16_t>(std::lround(charge_mah_));
  readings.capacity_mah = static_cast<std::uint16_t>(std::lround(kCapacity_mah));
}

}  // namespace roomwise::simulator
