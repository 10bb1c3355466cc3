#include "services/create_driver/create_service.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <stdexcept>

#include "common/create/create_messages.h"

namespace roomwise {
namespace {

constexpr Duration kTick = std::chrono::milliseconds(5);

create::Proof proof_of(Signature signature) {
  if (signature == Signature::kMissing) return create::Proof::kMissing;
  return signature == Signature::kGenuine ? create::Proof::kGenuine : create::Proof::kForged;
}

create::VelocityCommand command_of(const velocity_command_t& message, Signature signature) {
  return {.speed_mps = message.allowed_speed_mps,
          .turn_rate_radps = message.allowed_turn_rate_radps,
          .decided = time_from_utime(message.utime),
          .expiry = time_from_utime(message.expiry_utime),
          .session = message.session,
          .sequence = message.sequence,
          .proof = proof_of(signature)};
}

void fill_refusals(const create::DriverCounts& counts, create_state_t& state) {
  using create::DriverEvent;
  state.refused_unsigned = counts[DriverEvent::kCommandUnsigned];
  state.refused_forged = counts[DriverEvent::kCommandForged];
  state.refused_expired = counts[DriverEvent::kCommandExpired];
  state.refused_from_future = counts[DriverEvent::kCommandFromFuture];
  state.refused_out_of_order = counts[DriverEvent::kCommandOutOfOrder];
  state.refused_other_session = counts[DriverEvent::kCommandOtherSession];
  state.refused_malformed =
      counts[DriverEvent::kCommandNotFinite] + counts[DriverEvent::kCommandAbsurd];
}

}  // namespace

CreateService::CreateService(Bus& bus, const Params& params)
    : bus_(bus),
      model_(create::model_of(params)),
      driver_(params),
      link_(params),
      key_(params.key_path) {
  if (bus.is_replay()) {
    throw std::runtime_error("has nothing to replay: what it publishes comes from a robot's port");
  }
  bus_.subscribe(channels::kVelCmd, [this](const auto& message) { on_command(message); });
  bus_.every(kTick, [this](Time) { tick(); });
}

create::Instant CreateService::now() const {
  const auto steady = std::chrono::steady_clock::now().time_since_epoch();
  return {.steady = std::chrono::duration_cast<Duration>(steady), .wall = bus_.now()};
}

void CreateService::on_command(const velocity_command_t& message) {
  driver_.command(now(), command_of(message, key_.check(message)));
  say_key();
  say_counts();
}

void CreateService::tick() {
  const create::Instant time = now();
  if (!is_connected(time)) return;
  const auto received = link_.receive();
  link_.send(time.steady, driver_.step(time, received));
  link_.set_wake_line(driver_.pulls_wake_line(time.steady));
  for (const create::FrameReport& report : driver_.reports()) publish(report);
  say_counts();
  say_error();
}

bool CreateService::is_connected(const create::Instant& time) {
  if (link_.is_open()) return true;
  const bool has_opened = link_.open_if_due(time.steady);
  if (has_opened) {
    driver_.port_opened(now());  // starting the guardian took its time
    spdlog::info("create_driver: port open");
  }
  say_error();
  return has_opened;
}

void CreateService::publish(const create::FrameReport& report) {
  create_state_t state = create::to_message(report.time, model_, report.packets, report.mode);
  state.driver_state = static_cast<std::int8_t>(report.state);
  state.commanded_left_mps = report.commanded.left_mps;
  state.commanded_right_mps = report.commanded.right_mps;
  state.mode_drops = report.mode_drops;
  state.robot_restarts = report.robot_restarts;
  fill_refusals(driver_.counts(), state);
  bus_.publish(channels::kCreateState, state);
  if (!report.odometry) return;
  odometry_t odometry = create::to_message(*report.odometry);
  bus_.publish(channels::kOdometry, odometry);
}

void CreateService::say_counts() {
  for (std::size_t i = 0; i < static_cast<std::size_t>(create::DriverEvent::kCount); ++i) {
    const auto event = static_cast<create::DriverEvent>(i);
    const std::int64_t more = driver_.counts()[event] - said_[event];
    if (more == 0) continue;
    bus_.count(create::name_of(event), more);
    said_.add(event, more);
  }
}

void CreateService::say_key() {
  if (key_.error() == said_key_) return;
  said_key_ = key_.error();
  if (said_key_.empty()) return;
  bus_.note_error(said_key_);
  spdlog::warn("create_driver: {}", said_key_);
}

void CreateService::say_error() {
  if (!has_said_firmware_ && driver_.firmware()) {
    const create::Firmware& firmware = *driver_.firmware();
    spdlog::info("create_driver: robot's firmware is {}.{}.{}", firmware.major, firmware.minor,
                 firmware.patch);
    has_said_firmware_ = true;
  }
  if (link_.error() == said_error_) return;
  said_error_ = link_.error();
  if (said_error_.empty()) return;
  bus_.note_error(said_error_);
  spdlog::warn("create_driver: {}", said_error_);
}

}  // namespace roomwise
