#include "services/simulator/simulated_world.h"

#include <gtest/gtest.h>

#include "services/simulator/real_time.h"
#include "services/simulator/simulator_messages.h"

namespace roomwise::simulator {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A block ahead, a walker who crosses in front of it, one landmark.
Scene street() {
  Scene scene;
  scene.name = "street";
  scene.start = {1.0, 2.0, 0.5};
  scene.camera = {.x_m = 0.1, .z_m = 0.5, .pitch_down_rad = 0.2};
  scene.landmarks = {{.identity = 7, .kind = 1, .position_m = {3.0, 4.0}}};
  return scene;
}

Walker crossing(double x_m) {
  Walker walker;
  walker.way_m = {{x_m, -1.0}, {x_m, 1.0}};
  walker.speed_mps = 0.5;
  return walker;
}

void run(SimulatedWorld& world, Duration duration, Bytes& to_host) {
  for (const Duration end = world.now() + duration; world.now() < end;) world.step(to_host);
}

TEST(SimulatedWorld, StartsWhereTheSceneSays) {
  const SimulatedWorld world(street(), {});
  EXPECT_EQ(world.create().motion().pose().x_m, 1.0);
  EXPECT_EQ(world.create().motion().pose().heading_rad, 0.5);
}

TEST(SimulatedWorld, CameraRidesOnTheRobot) {
  const SimulatedWorld world(street(), {});
  const Eigen::Isometry3d T = world.T_world_camera();
  EXPECT_NEAR(T.translation().x(), 1.0 + 0.1 * std::cos(0.5), 1e-12);
  EXPECT_NEAR(T.translation().y(), 2.0 + 0.1 * std::sin(0.5), 1e-12);
  EXPECT_NEAR(T.translation().z(), 0.5, 1e-12);
  const Eigen::Vector3d ahead = T.rotation() * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(std::atan2(ahead.y(), ahead.x()), 0.5, 1e-12);
  EXPECT_NEAR(ahead.z(), -std::sin(0.2), 1e-12);
}

TEST(SimulatedWorld, WalkersAreMetWhereTheyAreByThen) {
  Scene scene;
  scene.walkers = {crossing(0.3)};
  SimulatedWorld world(scene, {});
  Bytes to_host;
  run(world, Duration(1'000'000), to_host);  // the walker is at y -0.5
  EXPECT_TRUE(world.create().motion().touches().empty());
  run(world, Duration(800'000), to_host);  // and now beside the robot, pushing it
  EXPECT_FALSE(world.create().motion().touches().empty());
  EXPECT_LT(world.create().motion().pose().x_m, -0.05);
}

TEST(SimulatedWorld, SameSeedAndBytesGiveTheSameBits) {
  const auto live = [](std::uint64_t seed) {
    Scene scene = street();
    scene.walkers = {crossing(2.0)};
    SimulatedCreate::Setup setup;
    setup.seed = seed;
    SimulatedWorld world(scene, setup);
    Bytes to_host;
    world.create().receive(Bytes{128, 131, 148, 1, 100, 145, 0, 250, 0, 200});
    run(world, Duration(4'000'000), to_host);
    return std::pair{to_host, world.create().motion().pose().x_m};
  };
  EXPECT_EQ(live(3), live(3));
  EXPECT_NE(live(3).second, live(4).second);
}

TEST(TruthMessage, SaysWhereRobotCameraAndLandmarksAre) {
  const SimulatedWorld world(street(), {});
  const truth_t truth = truth_message(world, time_from_utime(123), true);
  EXPECT_EQ(truth.utime, 123);
  EXPECT_EQ(truth.true_y_m, 2.0);
  EXPECT_EQ(truth.has_camera_pose, 1);
  EXPECT_EQ(truth.T_world_camera_translation_m[2], 0.5);
  const Eigen::Quaterniond q(truth.T_world_camera_quat[0], truth.T_world_camera_quat[1],
                             truth.T_world_camera_quat[2], truth.T_world_camera_quat[3]);
  EXPECT_TRUE(q.toRotationMatrix().isApprox(world.T_world_camera().rotation(), 1e-12));
  ASSERT_EQ(truth.landmark_count, 1);
  EXPECT_EQ(truth.true_landmarks[0].identity, 7);
  EXPECT_EQ(truth.true_landmarks[0].true_y_m, 4.0);
  EXPECT_EQ(truth_message(world, time_from_utime(123), false).landmark_count, 0);
}

TEST(RealTime, StampsFollowAWallClockThatIsSet) {
  const Time start = time_from_utime(1'000'000'000);
  RealTime time(start);
  EXPECT_FALSE(time.follow(start + time.elapsed()));
  EXPECT_EQ(time.stamp(Duration(5)), start + Duration(5));
  EXPECT_TRUE(time.follow(start + std::chrono::hours(1)));
  EXPECT_GT(time.stamp(Duration(0)), start + std::chrono::minutes(59));
  EXPECT_TRUE(time.follow(start)) << "and when it is set back";
}

TEST(RealTime, SkippedTimeIsNotLivedThrough) {
  const Time start = time_from_utime(1'000'000'000);
  RealTime time(start);
  time.skip(std::chrono::hours(1));
  EXPECT_LT(time.elapsed(), Duration(0));
  EXPECT_EQ(time.stamp(Duration(0)), start + std::chrono::hours(1));
}

}  // namespace
}  // namespace roomwise::simulator
