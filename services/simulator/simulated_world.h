#pragma once
#include <cstdint>
#include <vector>

#include "services/simulator/core/create/simulated_create.h"
#include "services/simulator/core/ground_plan.h"
#include "services/simulator/core/scene.h"

namespace roomwise::simulator {

/// A scene and the Create in it, stepping together. Knows no clock and no file: the same scene,
/// set-up and bytes give the same bits, as fast as it is stepped.
class SimulatedWorld {
 public:
  /// The robot starts where the scene says, whatever `setup` holds.
  SimulatedWorld(Scene scene, SimulatedCreate::Setup setup);

  /// Moves on by SimulatedCreate::kStep; appends to `to_host` what comes out of the serial port.
  void step(std::vector<std::uint8_t>& to_host);

  Duration now() const { return create_.now(); }
  const Scene& scene() const { return scene_; }
  SimulatedCreate& create() { return create_; }
  const SimulatedCreate& create() const { return create_; }

  bool has_camera() const { return !create_.any_active(FaultKind::kCameraUnplug); }
  /// Pose of the camera frame (x right, y down, z forward) in the world.
  Eigen::Isometry3d T_world_camera() const;

 private:
  void look_around();

  Scene scene_;
  GroundPlan plan_;  ///< whole; of a scene with walkers only as they were when last looked at
  GroundPlan near_;  ///< what the robot can meet before it next looks around
  SimulatedCreate create_;
};

}  // namespace roomwise::simulator
