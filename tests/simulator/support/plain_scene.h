#pragma once
#include <Eigen/Geometry>
#include <string>

#include "services/simulator/core/scene.h"
#include "services/simulator/core/scene_solids.h"

namespace roomwise::simulator {

/// A world for one test: grey things, no lamps.
class PlainScene {
 public:
  PlainScene() {
    scene_.name = "plain";
    scene_.materials.push_back({.name = "grey"});
    scene_.ambient = 1.0;
  }

  /// Adds a material; what is put down from here on is made of it.
  PlainScene& made_of(const Material& material) {
    scene_.materials.push_back(material);
    material_ = static_cast<int>(scene_.materials.size()) - 1;
    return *this;
  }

  PlainScene& put(const Solid& solid, SurfaceClass surface_class = SurfaceClass::kObstacle) {
    add_to(scene_, solid, material_, surface_class);
    return *this;
  }

  /// A wall across the whole view `x_m` ahead of the world's origin.
  PlainScene& put_wall(double x_m) {
    return put(box({x_m, -30.0, -30.0}, {x_m + 1.0, 30.0, 30.0}), SurfaceClass::kWall);
  }

  PlainScene& put_floor() {
    return put(level_rectangle({-50.0, -50.0}, {50.0, 50.0}, 0.0, true), SurfaceClass::kFloor);
  }

  Scene& scene() { return scene_; }

 private:
  Scene scene_;
  int material_ = 0;
};

/// A camera at the world's origin, `height_m` up, looking along x and down by `pitch_down_rad`.
inline Eigen::Isometry3d camera_pose(double height_m, double pitch_down_rad = 0.0) {
  return T_robot_camera(CameraMount{.z_m = height_m, .pitch_down_rad = pitch_down_rad});
}

}  // namespace roomwise::simulator
