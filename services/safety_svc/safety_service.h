#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "common/auth/secret_key.h"
#include "common/bus/bus.h"
#include "services/safety_svc/core/decide.h"

namespace roomwise {

/// What differs from robot to robot; services/safety_svc/params.toml may override any field.
struct SafetyServiceParams {
  safety::SafetyParams robot;
  std::string key_path;  ///< of the key that signs VEL_CMD; empty: drive.key in /tmp/roomwise-UID
  bool make_key = true;  ///< a new key at every start; false: the one a person put at key_path

  template <class Field>
  void visit_fields(Field&& field) {
    robot.visit_fields(field);
    field("key_path", key_path);
    field("make_key", make_key);
  }
};

/// VEL_REQUEST, ESTOP and SAFETY_RESET in, and all that says whether the way is clear; VEL_CMD out
/// at 50 Hz, always, zero when in doubt, and at once when the robot itself feels something;
/// SAFETY_STATE at 10 Hz and when the reason changes.
///
/// A replay decides by the log's time, as the ticks fall, and signs nothing: what it publishes
/// moves no robot.
class SafetyService {
 public:
  using Params = SafetyServiceParams;

  /// Live, throws std::runtime_error if there is no key to be had.
  SafetyService(Bus& bus, const Params& params);

 private:
  void on_create_state(const create_state_t& message);
  void on_estop(const estop_t& message);
  void on_reset(const safety_reset_t& message);
  void decide();
  void publish_command(const safety::Instant& now, const safety::Decision& decision);
  void publish_state_if_due(const safety::Instant& now, const safety::Decision& decision);
  void note(const char* input, safety::InputResult result);
  safety::Instant now() const;

  Bus& bus_;
  Params params_;
  std::optional<SecretKey> key_;
  safety::World world_;
  safety::Granted granted_;
  safety_state_t state_{};
  std::int64_t session_ = 1;
  std::int64_t sequence_ = 0;
  std::optional<Duration> state_said_;
  safety::Decision said_;
};

}  // namespace roomwise
