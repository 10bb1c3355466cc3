#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "common/bus/bus.h"
#include "services/simulator/camera_feed.h"
#include "services/simulator/device/pty.h"
#include "services/simulator/real_time.h"
#include "services/simulator/simulated_world.h"
#include "services/simulator/simulator_params.h"

namespace roomwise::simulator {

/// The simulated world in real time: a Create on a pseudo-terminal, TRUTH at 60 Hz with the true
/// landmarks once a second, and a Kinect's frames at 30 Hz behind the frame door.
///
/// The world lives in steps of a millisecond by the monotonic clock. After a hiccup it lives
/// through every step it missed, up to catch_up_s; what is left out beyond that is counted.
class SimulatorService {
 public:
  using Params = SimulatorParams;

  /// Throws std::runtime_error on a scenario or fault that cannot be read, a port that cannot be
  /// made, and in a replay: a simulator has no input to replay.
  SimulatorService(Bus& bus, const Params& params);

 private:
  void advance();
  void listen();
  void step();
  void show();
  void answer();

  Bus& bus_;
  Duration longest_catch_up_;
  SimulatedWorld world_;
  Pty port_;
  RealTime real_time_;
  std::function<void()> plug_camera_;
  std::optional<CameraFeed> camera_;  ///< plugged in
  std::vector<std::uint8_t> from_host_;
  std::vector<std::uint8_t> to_host_;
  std::int64_t line_bytes_lost_ = 0;
  std::int64_t camera_moments_dropped_ = 0;
};

}  // namespace roomwise::simulator
