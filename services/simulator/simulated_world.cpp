#include "services/simulator/simulated_world.h"

#include <utility>

#include "services/simulator/core/contact.h"

namespace roomwise::simulator {
namespace {

/// Walkers move this long at a time: 15 mm at a brisk walk.
constexpr Duration kLookEvery{10'000};
/// Farther than the light bumpers see from the centre of the robot, and what it moves meanwhile.
constexpr double kNear_m = 1.0;

SimulatedCreate::Setup placed(SimulatedCreate::Setup setup, const Pose2& T_world_robot) {
  setup.T_world_robot = T_world_robot;
  return setup;
}

Eigen::Isometry3d upright(const Pose2& T_world_robot) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translate(Eigen::Vector3d(T_world_robot.x_m, T_world_robot.y_m, 0.0));
  T.rotate(Eigen::AngleAxisd(T_world_robot.heading_rad, Eigen::Vector3d::UnitZ()));
  return T;
}

}  // namespace

SimulatedWorld::SimulatedWorld(Scene scene, SimulatedCreate::Setup setup)
    : scene_(std::move(scene)),
      plan_(ground_plan(scene_, 0.0)),
      create_(placed(std::move(setup), scene_.start)) {}

void SimulatedWorld::step(std::vector<std::uint8_t>& to_host) {
  if (now() % kLookEvery == Duration{0}) look_around();
  create_.step(near_, to_host);
}

void SimulatedWorld::look_around() {
  if (!scene_.walkers.empty()) plan_ = ground_plan(scene_, seconds(now()));
  keep_near(plan_, create_.motion().pose().position_m(), kNear_m, near_);
}

Eigen::Isometry3d SimulatedWorld::T_world_camera() const {
  return upright(create_.motion().pose()) * T_robot_camera(scene_.camera);
}

}  // namespace roomwise::simulator
