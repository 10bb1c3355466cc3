#pragma once
#include <string>

#include "common/bus/bus.h"
#include "services/create_driver/core/create_driver.h"
#include "services/create_driver/device/robot_link.h"
#include "services/create_driver/key_watch.h"

namespace roomwise {

/// VEL_CMD in, obeyed only if safety_svc's key signed it; CREATE_STATE with every frame of the
/// robot and ODOMETRY with every step out.
///
/// Reads and writes the port in a tick of 5 ms on the bus's one thread: no lock, one order of
/// events, and a service that hangs anywhere also stops beating to its guardian.
class CreateService {
 public:
  using Params = create::CreateParams;

  /// Throws std::runtime_error in replay: what it publishes comes from a robot, not from a log.
  CreateService(Bus& bus, const Params& params);

 private:
  void on_command(const velocity_command_t& message);
  void tick();
  bool is_connected(const create::Instant& now);
  void publish(const create::FrameReport& report);
  void say_counts();
  void say_key();
  void say_error();
  create::Instant now() const;

  Bus& bus_;
  create::Model model_;
  create::CreateDriver driver_;
  create::RobotLink link_;
  KeyWatch key_;
  create::DriverCounts said_;
  std::string said_error_;
  std::string said_key_;
  bool has_said_firmware_ = false;
};

}  // namespace roomwise
