// What World takes of its inputs, and when it calls the robot calm.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/safety_svc/support/driven_world.h"

namespace roomwise::safety {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(World, TakesFloorAsSeenFromWhereItIsToldOrElseFromTheMounting) {
  const auto speed_after_5_s = [](double floor_seen_from_m) {
    DrivenWorld drive;
    drive.params.floor_seen_from_m = floor_seen_from_m;
    drive.world = World(drive.params);
    drive.ask(0.3, 0.0);
    return drive.run(seconds(5)).granted.speed_mps;
  };
  EXPECT_GT(speed_after_5_s(0.2), 0.29);
  EXPECT_LT(speed_after_5_s(0.0), 0.15) << "creeps over what the camera cannot have seen";
}

TEST(World, SaysWhyAnInputIsNotUsed) {
  DrivenWorld drive;
  const Instant now = drive.now();
  World& world = drive.world;
  EXPECT_EQ(world.hear_view(now, drive.view()), InputResult::kNoMount);
  EXPECT_EQ(world.hear_frame(now, now.wall, {}), InputResult::kMalformed);
  EXPECT_EQ(world.hear_frame(now, now.wall, DrivenWorld::camera()), InputResult::kUsed);
  EXPECT_EQ(world.hear_frame(now, now.wall, DrivenWorld::camera()), InputResult::kOutOfOrder);
  EXPECT_EQ(world.hear_view(now, drive.view()), InputResult::kNoPose);
  EXPECT_EQ(world.hear_odometry(now, drive.odometry_sample()), InputResult::kUsed);
  EXPECT_EQ(world.hear_odometry(now, drive.odometry_sample()), InputResult::kOutOfOrder);
  FloorView view = drive.view();
  view.free.bearing_step_rad = 9.0;
  EXPECT_EQ(world.hear_view(now, view), InputResult::kMalformed);
  EXPECT_FALSE(world.view.is_fresh(now, seconds(9))) << "what was not used was not heard";
  EXPECT_EQ(world.hear_view(now, drive.view()), InputResult::kUsed);
  EXPECT_EQ(world.hear_body(now, now.wall - seconds(2), {}), InputResult::kOld);
  EXPECT_EQ(world.hear_body(now, now.wall + seconds(2), {}), InputResult::kFromFuture);
  OdometrySample sample = drive.odometry_sample();
  sample.time += milliseconds(1);
  sample.interval = Duration(0);
  EXPECT_EQ(world.hear_odometry(now, sample), InputResult::kMalformed);
  sample.time += seconds(1);
  EXPECT_EQ(world.hear_odometry(now, sample), InputResult::kFromFuture);
  EXPECT_TRUE(world.odometry.is_distrusted(now));
}

TEST(World, ATiltedCameraStopsTheWayAheadOnly) {
  DrivenWorld drive;
  drive.ask(0.2, 0.0);
  drive.run(seconds(2));
  drive.has_camera = false;
  FloorView view = drive.view();
  view.time += milliseconds(1);
  view.floor_height_m = 0.8;
  view.is_plane_trusted = false;
  EXPECT_EQ(drive.world.hear_view(drive.now(), view), InputResult::kUsed);
  EXPECT_FALSE(drive.world.is_tilted());
  view.time += milliseconds(1);
  view.is_plane_trusted = true;
  EXPECT_EQ(drive.world.hear_view(drive.now(), view), InputResult::kUsed);
  EXPECT_EQ(drive.step().first, Reason::kTilt);
  drive.ask(0.0, 0.5);
  EXPECT_GT(drive.step().granted.turn_rate_radps, 0.0);
}

TEST(World, IsCalmOnlyIfNothingMovesAsksOrPresses) {
  DrivenWorld drive;
  drive.ask(0.0, 0.0);
  drive.run(milliseconds(100));
  EXPECT_TRUE(drive.world.is_calm(drive.now()));
  drive.ask(0.0, 0.5);
  drive.step();
  EXPECT_FALSE(drive.world.is_calm(drive.now()));
  drive.asks = false;
  drive.run(milliseconds(200));
  EXPECT_TRUE(drive.world.is_calm(drive.now()));
  for (const auto sensor : {&BodyState::bump, &BodyState::wheel_drop}) {
    drive.body.*sensor = true;
    drive.step();
    EXPECT_FALSE(drive.world.is_calm(drive.now()));
    drive.body.*sensor = false;
  }
  drive.asks = true;
  drive.ask(0.0, 0.5);
  drive.run(milliseconds(200));
  drive.asks = false;
  drive.has_odometry = false;  // it still turns, and nobody asks
  drive.run(kRequestLife + milliseconds(20));
  EXPECT_FALSE(drive.world.is_calm(drive.now()));
  drive.has_odometry = true;
  drive.run(milliseconds(200));
  EXPECT_TRUE(drive.world.is_calm(drive.now()));
  drive.asks = true;
  drive.ask(std::numeric_limits<double>::quiet_NaN(), 0.0);
  drive.step();
  EXPECT_FALSE(drive.world.is_calm(drive.now()));
}

}  // namespace
}  // namespace roomwise::safety
