#include "services/simulator/core/create/open_interface.h"

#include <array>
#include <stdexcept>
#include <utility>

#include "services/simulator/core/create/boot_banner.h"

namespace roomwise::simulator {
namespace {

constexpr double kBaseCreate1_m = 0.258;
constexpr double kBaseCreate2_m = 0.235;
constexpr Duration kBannerAfter{100'000};
/// Script bytes run at once: more means a script that calls itself without a wait.
constexpr int kScriptBytesPerStep = 100;
/// The Create by itself, cleaning or covering: a wide spiral, turning in place while it bumps.
constexpr LeftRight<double> kRoaming_mps{0.20, 0.25};
constexpr LeftRight<double> kRoamingBumped_mps{0.10, -0.10};

Duration duration_of(double duration_s) {
  return std::chrono::duration_cast<Duration>(std::chrono::duration<double>(duration_s));
}

CreateModel model_of(const std::string& name) {
  if (name == "create1") return CreateModel::kCreate1;
  if (name == "create2") return CreateModel::kCreate2;
  throw std::invalid_argument("model must be create1 or create2, not " + name);
}

int default_baud(CreateModel model) { return model == CreateModel::kCreate1 ? 57600 : 115200; }

OiOdometer::Setup odometer_setup(const OpenInterfaceParams& params, double wheel_base_m) {
  const bool old = params.firmware == "3.2.6";
  const bool wrong_angle = old || params.firmware == "3.4.0";
  return {.wheel_base_m = wheel_base_m,
          .carries = params.odometry_rounding == "carry",
          .distance_ratio = old ? 0.5 : 1.0,
          .angle_ratio = wrong_angle ? 0.324056 : 1.0};
}

}  // namespace

OpenInterface::OpenInterface(const OpenInterfaceParams& params)
    : params_(params),
      model_(model_of(params.model)),
      wheel_base_m_(model_ == CreateModel::kCreate1 ? kBaseCreate1_m : kBaseCreate2_m),
      baud_(default_baud(model_)),
      reader_(model_),
      odometer_(odometer_setup(params, wheel_base_m_)) {}

void OpenInterface::step(Duration now) {
  now_ = now;
  if (banner_due_ && now_ >= *banner_due_) {
    const std::string banner = boot_banner(params_.firmware);
    transmissions_.push_back({{banner.begin(), banner.end()}, false});
    banner_due_.reset();
  }
  fall_asleep_if_idle();
  run_script();
}

void OpenInterface::receive(std::uint8_t byte) {
  if (is_deaf() || script_.is_waiting()) return;
  interpret(byte);
}

void OpenInterface::interpret(std::uint8_t byte) {
  if (reader_.push(byte)) obey(reader_.command());
}

void OpenInterface::obey(const OiCommand& command) {
  if (!accepts(model_, mode_, command.opcode)) return;
  switch (command.opcode) {
    case op::kReset:
      return reboot();
    case op::kDrive:
    case op::kDriveDirect:
    case op::kDrivePwm:
      return obey_drive(command);
    case op::kSensors:
    case op::kStream:
    case op::kQueryList:
    case op::kPauseResume:
    case op::kShowScript:
      return obey_sensing(command);
    case op::kBaud:
    case op::kSong:
    case op::kPlay:
    case op::kScript:
    case op::kPlayScript:
    case op::kWaitTime:
    case op::kWaitDistance:
    case op::kWaitAngle:
    case op::kWaitEvent:
      return obey_other(command);
    default:
      return obey_mode(command.opcode);  // lamps, brushes and clocks change nothing here
  }
}

void OpenInterface::obey_mode(std::uint8_t opcode) {
  const bool is_locked_out = locked_ && opcode >= op::kStart && opcode <= op::kFull;
  if (is_locked_out) return;
  switch (opcode) {
    case op::kStart:
      return enter(OiMode::kPassive);
    case op::kControl:
    case op::kSafe:
      return enter(OiMode::kSafe);
    case op::kFull:
      return enter(OiMode::kFull);
    case op::kSpot:
    case op::kClean:
    case op::kMax:
    case op::kSeekDock:
      enter(OiMode::kPassive);
      roams_ = true;
      return;
    case op::kPower:
      power_off();
      asleep_ = true;
      return;
    case op::kStop:
      return power_off();
    default:
      return;
  }
}

void OpenInterface::enter(OiMode mode) {
  if (mode != mode_ || roams_) drive_.stop();
  roams_ = false;
  mode_ = mode;
  awake_since_ = now_;
  listens_from_ = now_ + duration_of(params_.mode_settle_s);
}

void OpenInterface::power_off() {
  drive_.stop();
  roams_ = false;
  mode_ = OiMode::kOff;
  stream_.clear();
  script_.clear();
}

void OpenInterface::obey_drive(const OiCommand& command) {
  if (command.opcode == op::kDrive) {
    return drive_.set_arc(command.word(0), command.word(2), wheel_base_m_);
  }
  const LeftRight<std::int16_t> wheels{.left = command.word(2), .right = command.word(0)};
  if (command.opcode == op::kDriveDirect) return drive_.set_direct(wheels);
  drive_.set_pwm(wheels);
}

void OpenInterface::obey_other(const OiCommand& command) {
  switch (command.opcode) {
    case op::kBaud:
      return set_baud(command.arguments[0]);
    case op::kSong:
      return song_.define(command.arguments);
    case op::kPlay:
      return song_.play(command.arguments[0], now_);
    case op::kScript:
      return script_.store({command.arguments.begin() + 1, command.arguments.end()});
    case op::kPlayScript:
      return script_.play();
    default:
      return script_.wait(command, wait_inputs());
  }
}

void OpenInterface::set_baud(std::uint8_t code) {
  constexpr std::array kBauds = {300,   600,   1200,  2400,  4800,  9600,
                                 14400, 19200, 28800, 38400, 57600, 115200};
  if (code < kBauds.size()) baud_ = kBauds[code];
}

LeftRight<double> OpenInterface::wheel_command_mps() const {
  if (!roams_) return drive_.wheels_mps();
  return body_.bump.left || body_.bump.right ? kRoamingBumped_mps : kRoaming_mps;
}

void OpenInterface::trip_if_unsafe() {
  if (mode_ != OiMode::kSafe) return;
  const bool at_cliff = body_.any_cliff() && drive_.minds_cliffs(wheel_base_m_);
  if (!at_cliff && !body_.any_wheel_drop() && !body_.on_charger()) return;
  drop_to_passive();
  if (params_.locks_after_trip) lock();
}

void OpenInterface::drop_to_passive() {
  if (mode_ == OiMode::kOff) return;
  enter(OiMode::kPassive);
  drive_.stop();
}

void OpenInterface::lock() {
  drop_to_passive();
  locked_ = true;
}

void OpenInterface::reboot() {
  OpenInterface fresh(params_);
  fresh.boots_ = boots_ + 1;
  fresh.now_ = now_;
  fresh.banner_due_ = now_ + kBannerAfter;
  fresh.listens_from_ = now_ + duration_of(params_.boot_s);
  fresh.body_ = body_;
  fresh.odometer_.start_at(body_.turned_m);
  fresh.transmissions_ = std::move(transmissions_);
  *this = std::move(fresh);
}

void OpenInterface::press_power_button() {
  asleep_ = false;
  awake_since_ = now_;
}

void OpenInterface::fall_asleep_if_idle() {
  const bool idles = mode_ == OiMode::kPassive && !roams_ && !body_.on_charger();
  if (!idles || now_ - awake_since_ < duration_of(params_.sleep_after_s)) return;
  power_off();
  asleep_ = true;
}

void OpenInterface::run_script() {
  script_.update(wait_inputs(), body_);
  for (int i = 0; i < kScriptBytesPerStep; ++i) {
    const auto byte = script_.next_byte();
    if (!byte) return;
    interpret(*byte);
  }
}

}  // namespace roomwise::simulator
