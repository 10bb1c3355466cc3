#include "services/simulator/core/create/simulated_create.h"

#include <algorithm>
#include <utility>

#include "services/simulator/core/create/body_sensors.h"

namespace roomwise::simulator {
namespace {

constexpr double kLowBattery_ratio = 0.05;
/// Where the counters stand after a rollover fault: 0.1 m of travel before they wrap.
constexpr std::uint16_t kNearRollover_ticks = 225;
constexpr std::uint16_t kHeader = 19;
constexpr std::uint16_t kHeaderTwice = 0x1313;

std::uint16_t sum(std::uint16_t a, std::uint16_t b) { return static_cast<std::uint16_t>(a + b); }

std::uint16_t difference(std::uint16_t a, std::uint16_t b) {
  return static_cast<std::uint16_t>(a - b);
}

}  // namespace

SimulatedCreate::SimulatedCreate(const Setup& setup)
    : robot_params_(setup.robot),
      interface_(setup.interface),
      motion_(setup.robot, interface_.wheel_base_m(), setup.T_world_robot,
              std::mt19937_64(setup.seed)),
      battery_(setup.battery_ratio),
      faults_(setup.faults),
      line_faults_(setup.faults),
      host_baud_(interface_.baud()) {
  sense({});
}

void SimulatedCreate::receive(std::span<const std::uint8_t> bytes) {
  if (has_port()) to_robot_.send(bytes);
}

bool SimulatedCreate::has_port() const { return !any_active(FaultKind::kHangUp); }

bool SimulatedCreate::any_active(FaultKind kind) const {
  return std::any_of(faults_.begin(), faults_.end(), [&](const Fault& fault) {
    return fault.kind == kind && fault.is_active(now_);
  });
}

void SimulatedCreate::step(const GroundPlan& plan, std::vector<std::uint8_t>& to_host) {
  begin_due_faults();
  now_ += kStep;
  interface_.step(now_);
  read_from_host();
  move(plan);
  if (now_ % OpenInterface::kSensorPeriod == Duration{0}) sense(plan);
  write_to_host(to_host);
}

void SimulatedCreate::begin_due_faults() {
  for (const Fault& fault : faults_) {
    if (fault.at >= now_ && fault.at < now_ + kStep) begin(fault);
  }
}

void SimulatedCreate::begin(const Fault& fault) {
  switch (fault.kind) {
    case FaultKind::kReboot:
      return interface_.reboot();
    case FaultKind::kModeDrop:
      return interface_.drop_to_passive();
    case FaultKind::kMode32:
      return interface_.lock();
    case FaultKind::kPowerButton:
      return interface_.press_power_button();
    case FaultKind::kBatteryLow:
      return battery_.set_charge(kLowBattery_ratio);
    case FaultKind::kRolloverForward:
      return set_encoders(static_cast<std::uint16_t>(65536 - kNearRollover_ticks));
    case FaultKind::kRolloverBackward:
      return set_encoders(kNearRollover_ticks);
    default:
      return;  // lasts, or happens on the line
  }
}

void SimulatedCreate::read_from_host() {
  arrived_.clear();
  to_robot_.advance(now_, host_baud_, arrived_);
  for (const std::uint8_t byte : received_at(arrived_, host_baud_, interface_.baud())) {
    interface_.receive(byte);
  }
}

void SimulatedCreate::move(const GroundPlan& plan) {
  const double dt_s = seconds(kStep);
  motion_.step(plan, interface_.wheel_command_mps(), dt_s);
  const bool may_charge =
      interface_.mode() == OiMode::kOff || interface_.mode() == OiMode::kPassive;
  const auto& currents = readings_.wheel_current_ma;
  battery_.step(currents.left + currents.right, readings_.on_charger() && may_charge, dt_s);
}

void SimulatedCreate::set_encoders(std::uint16_t ticks) {
  const LeftRight<Wheel>& wheels = motion_.wheels();
  encoder_offset_ticks_ = {difference(ticks, encoder_ticks(wheels.left.turned_m)),
                           difference(ticks, encoder_ticks(wheels.right.turned_m))};
}

void SimulatedCreate::sense(const GroundPlan& plan) {
  const LeftRight<std::uint16_t> shown = readings_.encoder_ticks;
  readings_ = read_body(motion_, plan, robot_params_);
  if (std::exchange(boots_seen_, interface_.boots()) != interface_.boots()) set_encoders(0);
  show_encoders(shown);
  battery_.report(readings_);
  spoil_readings(readings_);
  interface_.sense(readings_);
}

/// Ticks turned become counters; one that is stuck stays at `shown` and misses what is turned.
void SimulatedCreate::show_encoders(const LeftRight<std::uint16_t>& shown) {
  const LeftRight<std::uint16_t> turned = readings_.encoder_ticks;
  for (const Fault& fault : faults_) {
    if (fault.kind != FaultKind::kEncoderStuck || !fault.is_active(now_)) continue;
    if (fault.sides.left) encoder_offset_ticks_.left = difference(shown.left, turned.left);
    if (fault.sides.right) encoder_offset_ticks_.right = difference(shown.right, turned.right);
  }
  readings_.encoder_ticks = {sum(turned.left, encoder_offset_ticks_.left),
                             sum(turned.right, encoder_offset_ticks_.right)};
}

void SimulatedCreate::spoil_readings(BodyReadings& readings) const {
  for (const Fault& fault : faults_) {
    if (!fault.is_active(now_)) continue;
    switch (fault.kind) {
      case FaultKind::kBump:
        readings.bump.left |= fault.sides.left;
        readings.bump.right |= fault.sides.right;
        break;
      case FaultKind::kWheelDrop:
        readings.wheel_drop.left |= fault.sides.left;
        readings.wheel_drop.right |= fault.sides.right;
        break;
      case FaultKind::kCliff:
        readings.cliff = {fault.sides.left, fault.sides.left, fault.sides.right, fault.sides.right};
        break;
      case FaultKind::kCharger:
        readings.internal_charger = true;
        break;
      case FaultKind::kNineteenInData:
        readings.temperature_c = kHeader;
        readings.cliff_signal.fill(kHeaderTwice);
        readings.light_signal.fill(kHeaderTwice);
        break;
      default:
        break;
    }
  }
}

void SimulatedCreate::write_to_host(std::vector<std::uint8_t>& to_host) {
  std::vector<Transmission> transmissions = interface_.take_transmissions();
  line_faults_.spoil(now_, transmissions);
  for (const Transmission& transmission : transmissions) to_host_.send(transmission.bytes);
  arrived_.clear();
  to_host_.advance(now_, interface_.baud(), arrived_);
  if (!has_port() || any_active(FaultKind::kSilence)) return;
  const auto received = received_at(arrived_, interface_.baud(), host_baud_);
  to_host.insert(to_host.end(), received.begin(), received.end());
}

}  // namespace roomwise::simulator
