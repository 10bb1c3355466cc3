#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "services/simulator/core/create/battery.h"
#include "services/simulator/core/create/fault.h"
#include "services/simulator/core/create/line_faults.h"
#include "services/simulator/core/create/open_interface.h"
#include "services/simulator/core/create/serial_line.h"
#include "services/simulator/core/ground_plan.h"
#include "services/simulator/core/robot_motion.h"

namespace roomwise::simulator {

/// A whole Create: body, battery, firmware and serial line, and what goes wrong with them. Time
/// goes in fixed steps; same seed, same bytes at the same steps: the same bits.
class SimulatedCreate {
 public:
  static constexpr Duration kStep{1'000};

  struct Setup {
    RobotParams robot;
    OpenInterfaceParams interface;
    double battery_ratio = 0.9;  ///< charge at the start
    Pose2 T_world_robot;         ///< at the start
    std::vector<Fault> faults;
    std::uint64_t seed = 1;
  };
  explicit SimulatedCreate(const Setup& setup);

  /// The speed the host's port is set to: at another than the robot's both read garbage.
  void set_host_baud(int baud) { host_baud_ = std::clamp(baud, 50, 4'000'000); }

  /// Bytes the host has written; they reach the robot at the pace of the line.
  void receive(std::span<const std::uint8_t> bytes);

  /// Bytes written but not yet through the line.
  std::size_t bytes_waiting() const { return to_robot_.waiting(); }

  /// One kStep; appends to `to_host` what reaches the host in it.
  void step(const GroundPlan& plan, std::vector<std::uint8_t>& to_host);

  /// Since the start.
  Duration now() const { return now_; }
  const RobotMotion& motion() const { return motion_; }
  const OpenInterface& interface() const { return interface_; }

  /// False while the serial port is gone.
  /// Whether a fault of that kind lasts now.
  bool any_active(FaultKind kind) const;
  bool has_port() const;

  /// Bytes that found the robot's transmitter full.
  std::int64_t bytes_lost() const { return to_host_.lost(); }

 private:
  void begin_due_faults();
  void begin(const Fault& fault);
  void read_from_host();
  void move(const GroundPlan& plan);
  void sense(const GroundPlan& plan);
  void set_encoders(std::uint16_t ticks);
  void show_encoders(const LeftRight<std::uint16_t>& shown);
  void spoil_readings(BodyReadings& readings) const;
  void write_to_host(std::vector<std::uint8_t>& to_host);

  RobotParams robot_params_;
  OpenInterface interface_;
  RobotMotion motion_;
  Battery battery_;
  std::vector<Fault> faults_;
  LineFaults line_faults_;
  SerialLine to_robot_;
  SerialLine to_host_;
  int host_baud_;
  Duration now_{};
  BodyReadings readings_;
  int boots_seen_ = 0;
  LeftRight<std::uint16_t> encoder_offset_ticks_;  ///< counters minus ticks turned
  std::vector<std::uint8_t> arrived_;
};

}  // namespace roomwise::simulator
