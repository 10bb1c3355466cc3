#pragma once
#include <cstdint>
#include <optional>

#include "services/create_driver/core/driver_event.h"
#include "services/create_driver/core/instant.h"

namespace roomwise::create {

/// What the signature says of who sent a command.
enum class Proof : std::uint8_t { kMissing, kForged, kGenuine };

/// What VEL_CMD asks for, and who asks.
struct VelocityCommand {
  double speed_mps = 0.0;
  double turn_rate_radps = 0.0;
  Time decided{};
  Time expiry{};
  std::int64_t session = 0;
  std::int64_t sequence = 0;
  Proof proof = Proof::kMissing;
};

/// A command is obeyed this long, then the wheels stop.
inline constexpr Duration kCommandLife = std::chrono::milliseconds(200);
/// Clocks of one machine agree; handling takes time, not the other way round.
inline constexpr Duration kFutureSlack = std::chrono::milliseconds(50);

/// Why a command taken by itself must not be obeyed at `now`; nothing if it may. Who
/// sent it comes first: what a stranger says is not looked at.
std::optional<DriverEvent> refusal_of(const VelocityCommand& command, Time now);

/// Holds the one command that is in force. Denies by default: before the first command, after
/// kCommandLife and after a command's own expiry there is none.
///
/// One session is obeyed at a time: another may take over once the first has been silent for
/// kCommandLife. Inside a session the sequence must grow.
class CommandGate {
 public:
  /// Takes `command` up, or says why not and leaves the one in force as it was.
  std::optional<DriverEvent> offer(const Instant& now, const VelocityCommand& command);

  /// The command in force, if there is one.
  std::optional<VelocityCommand> in_force(const Instant& now) const;

  /// Drops the command in force. Its session and sequence are remembered.
  void drop() { is_dropped_ = true; }

 private:
  std::optional<DriverEvent> order_refusal(const Instant& now,
                                           const VelocityCommand& command) const;
  bool is_live(const Instant& now) const;

  std::optional<VelocityCommand> newest_;
  Duration received_{};
  bool is_dropped_ = false;
};

}  // namespace roomwise::create
