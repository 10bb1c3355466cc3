#include "services/simulator/core/scene.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "services/simulator/core/ground_plan.h"
#include "services/simulator/core/scene_solids.h"

namespace roomwise::simulator {
namespace {

Walker walker_around_a_square() {
  Walker walker;
  walker.way_m = {{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}};
  walker.speed_mps = 0.5;
  walker.start_m = 1.0;
  return walker;
}

TEST(WalkerPose, GoesAlongItsWayFacingAhead) {
  const Walker walker = walker_around_a_square();
  const Pose2 first = walker_pose(walker, 0.0);
  EXPECT_NEAR(first.x_m, 1.0, 1e-12);
  EXPECT_NEAR(first.heading_rad, 0.0, 1e-12);
  const Pose2 later = walker_pose(walker, 4.0);  // 3 m on: half up the second side
  EXPECT_NEAR((later.position_m() - Eigen::Vector2d(2.0, 1.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(later.heading_rad, std::numbers::pi / 2, 1e-12);
}

RC_GTEST_PROP(WalkerPose, RepeatsAfterOneRoundAndNeverJumps, ()) {
  const Walker walker = walker_around_a_square();
  const double t_s = *rc::gen::inRange(-100000, 100000) * 0.01;
  const Pose2 now = walker_pose(walker, t_s);
  RC_ASSERT((walker_pose(walker, t_s + 16.0).position_m() - now.position_m()).norm() < 1e-9);
  RC_ASSERT((walker_pose(walker, t_s + 0.1).position_m() - now.position_m()).norm() < 0.05 + 1e-9);
}

TEST(CameraMount, LooksForwardAndDown) {
  CameraMount mount;
  mount.x_m = 0.1;
  mount.z_m = 0.4;
  mount.pitch_down_rad = 0.2;
  const Eigen::Isometry3d T = T_robot_camera(mount);
  const Eigen::Vector3d ahead = T.linear() * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR((ahead - Eigen::Vector3d(std::cos(0.2), 0.0, -std::sin(0.2))).norm(), 0.0, 1e-12);
  EXPECT_NEAR((T.linear() * Eigen::Vector3d::UnitX() + Eigen::Vector3d::UnitY()).norm(), 0.0,
              1e-12);
  EXPECT_NEAR((T.translation() - Eigen::Vector3d(0.1, 0.0, 0.4)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(T.linear().determinant(), 1.0, 1e-12);
}

TEST(CameraMount, TurnsLeftBeforeItTilts) {
  CameraMount mount;
  mount.yaw_rad = std::numbers::pi / 2;
  mount.pitch_down_rad = 0.3;
  const Eigen::Vector3d ahead = T_robot_camera(mount).linear() * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR((ahead - Eigen::Vector3d(0.0, std::cos(0.3), -std::sin(0.3))).norm(), 0.0, 1e-12);
}

TEST(FindPath, FindsByNameOrNothing) {
  Scene scene;
  scene.paths = {{"loop1", {{1.0, 0.0}}, 1}, {"loop2", {{1.0, 0.0}}, 2}};
  EXPECT_EQ(find_path(scene, "loop2"), &scene.paths[1]);
  EXPECT_EQ(find_path(scene, "loop"), nullptr);
}

TEST(GroundPlan, HoldsOnlyWhatTheBodyCanMeet) {
  Scene scene;
  add_to(scene, box({0, 0, 0}, {1, 1, 0.5}), 0, SurfaceClass::kObstacle);
  add_to(scene, box({2, 0, 0.4}, {3, 1, 0.5}), 0, SurfaceClass::kObstacle);   // a table top
  add_to(scene, box({4, 0, -0.5}, {5, 1, -0.2}), 0, SurfaceClass::kDropOff);  // a step down
  add_to(scene, moved(cylinder(0.1, 0.0, 1.0), {6.0, 0.0, 0.0}), 0, SurfaceClass::kObstacle);
  scene.pits.push_back({{{4, 0}, {5, 0}, {5, 1}, {4, 1}}});
  Walker walker = walker_around_a_square();
  scene.walkers.push_back(walker);
  const GroundPlan plan = ground_plan(scene, 4.0);
  EXPECT_EQ(plan.walls.size(), 4U);
  EXPECT_EQ(plan.holes.size(), 1U);
  ASSERT_EQ(plan.discs.size(), 2U);
  EXPECT_EQ(plan.discs[1].center_m, walker_pose(walker, 4.0).position_m());
  EXPECT_EQ(ground_plan(scene, 0.0, 0.45).walls.size(), 8U);
}

TEST(Clearance, MeasuresToWallsDiscsAndHoles) {
  EXPECT_EQ(clearance_m({}, {0.0, 0.0}), std::numeric_limits<double>::infinity());
  GroundPlan plan;
  plan.walls.push_back({{0.0, 1.0}, {1.0, 1.0}});
  EXPECT_DOUBLE_EQ(clearance_m(plan, {0.5, 0.0}), 1.0);
  EXPECT_DOUBLE_EQ(clearance_m(plan, {2.0, 1.0}), 1.0);
  plan.discs.push_back({{0.5, -1.0}, 0.25});
  EXPECT_DOUBLE_EQ(clearance_m(plan, {0.5, 0.0}), 0.75);
  EXPECT_DOUBLE_EQ(clearance_m(plan, {0.5, -1.0}), -0.25);
  plan.holes.push_back({{{3, 0}, {5, 0}, {5, 2}, {3, 2}}});
  EXPECT_DOUBLE_EQ(clearance_m(plan, {2.5, 0.5}), 0.5);
  EXPECT_DOUBLE_EQ(clearance_m(plan, {4.0, 0.5}), -0.5);
}

}  // namespace
}  // namespace roomwise::simulator
