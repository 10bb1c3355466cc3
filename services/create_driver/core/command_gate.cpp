#include "services/create_driver/core/command_gate.h"

#include <cmath>

namespace roomwise::create {
namespace {

constexpr double kAbsurdSpeed_mps = 10.0;
constexpr double kAbsurdTurnRate_radps = 100.0;

}  // namespace

std::optional<DriverEvent> refusal_of(const VelocityCommand& command, Time now) {
  if (command.proof == Proof::kMissing) return DriverEvent::kCommandUnsigned;
  if (command.proof == Proof::kForged) return DriverEvent::kCommandForged;
  if (!std::isfinite(command.speed_mps) || !std::isfinite(command.turn_rate_radps)) {
    return DriverEvent::kCommandNotFinite;
  }
  if (std::abs(command.speed_mps) > kAbsurdSpeed_mps ||
      std::abs(command.turn_rate_radps) > kAbsurdTurnRate_radps) {
    return DriverEvent::kCommandAbsurd;
  }
  if (command.decided > now + kFutureSlack) return DriverEvent::kCommandFromFuture;
  if (command.decided < now - kCommandLife || command.expiry <= now) {
    return DriverEvent::kCommandExpired;
  }
  return std::nullopt;
}

std::optional<DriverEvent> CommandGate::offer(const Instant& now, const VelocityCommand& command) {
  if (const auto refusal = refusal_of(command, now.wall)) return refusal;
  if (const auto refusal = order_refusal(now, command)) return refusal;
  newest_ = command;
  received_ = now.steady;
  is_dropped_ = false;
  return std::nullopt;
}

std::optional<DriverEvent> CommandGate::order_refusal(const Instant& now,
                                                      const VelocityCommand& command) const {
  if (!newest_) return std::nullopt;
  if (command.session != newest_->session) {
    return is_live(now) ? std::optional(DriverEvent::kCommandOtherSession) : std::nullopt;
  }
  if (command.sequence <= newest_->sequence) return DriverEvent::kCommandOutOfOrder;
  return std::nullopt;
}

bool CommandGate::is_live(const Instant& now) const {
  return newest_ && now.steady - received_ < kCommandLife;
}

std::optional<VelocityCommand> CommandGate::in_force(const Instant& now) const {
  if (!is_live(now) || is_dropped_ || newest_->expiry <= now.wall) return std::nullopt;
  return newest_;
}

}  // namespace roomwise::create
