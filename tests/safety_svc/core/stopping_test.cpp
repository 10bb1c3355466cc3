// decide() when a robot feels, hears or is told what stops it.
#include "services/safety_svc/core/stopping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/safety_svc/support/driven_world.h"

namespace roomwise::safety {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(Stopping, ABumpStopsAllButTheWayBackAndIsRemembered) {
  DrivenWorld drive;
  drive.ask(0.3, 0.0);
  drive.run(seconds(4));
  drive.body.bump = true;
  Decision decision = drive.step();
  EXPECT_EQ(decision.granted.speed_mps, 0.0);
  EXPECT_EQ(decision.first, Reason::kBump);
  drive.ask(0.0, 1.0);
  EXPECT_EQ(drive.step().granted.turn_rate_radps, 0.0);
  drive.ask(-0.1, 0.0);
  drive.run(milliseconds(200));
  EXPECT_LT(drive.granted.motion.speed_mps, 0.0);
  drive.body.bump = false;
  drive.ask(0.3, 0.0);
  decision = drive.run(milliseconds(500));
  EXPECT_EQ(decision.granted.speed_mps, 0.0) << "the same place again";
  EXPECT_EQ(decision.first, Reason::kRemembered);
}

TEST(Stopping, ACliffStopsAllButTheWayBack) {
  DrivenWorld drive;
  drive.ask(0.3, 0.0);
  drive.run(seconds(4));
  drive.body.cliff = true;
  EXPECT_EQ(drive.run(milliseconds(200)).first, Reason::kCliff);
  drive.body.cliff = false;
  EXPECT_EQ(drive.run(milliseconds(200)).first, Reason::kDropOff);
}

TEST(Stopping, WhatWasFeltForAMomentIsRemembered) {
  for (const auto& [felt, why] : std::vector<std::pair<bool BodyState::*, Reason>>{
           {&BodyState::bump, Reason::kRemembered}, {&BodyState::cliff, Reason::kDropOff}}) {
    DrivenWorld drive;
    drive.ask(0.3, 0.0);
    drive.run(seconds(4));
    drive.body.*felt = true;
    drive.step();  // one message
    drive.body.*felt = false;
    EXPECT_EQ(drive.run(milliseconds(200)).first, why);
  }
}

TEST(Stopping, TheRobotsSensorsStopIt) {
  const std::vector<std::pair<bool BodyState::*, Reason>> cases = {
      {&BodyState::wheel_drop, Reason::kWheelDrop},
      {&BodyState::overcurrent, Reason::kOvercurrent},
      {&BodyState::is_charging, Reason::kCharging},
      {&BodyState::virtual_wall, Reason::kWall},
      {&BodyState::bump, Reason::kBump},
      {&BodyState::cliff, Reason::kCliff}};
  for (const auto& [sensor, reason] : cases) {
    DrivenWorld drive;
    drive.ask(0.3, 0.0);
    drive.run(seconds(3));
    drive.body.*sensor = true;
    const Decision decision = drive.step();
    EXPECT_EQ(decision.granted.speed_mps, 0.0);
    EXPECT_EQ(decision.first, reason);
  }
  DrivenWorld drive;
  drive.ask(0.3, 0.0);
  drive.run(seconds(3));
  drive.body.is_in_driving_mode = false;
  EXPECT_EQ(drive.step().first, Reason::kMode);
}

TEST(Stopping, NearAWallItCreeps) {
  DrivenWorld drive;
  drive.body.near_wall = true;
  drive.ask(0.3, 0.0);
  const Decision decision = drive.run(seconds(8));
  EXPECT_DOUBLE_EQ(decision.granted.speed_mps, kCreep_mps);
  EXPECT_EQ(decision.first, Reason::kWall);
}

TEST(Stopping, RampsUpFromZeroAfterEveryStop) {
  DrivenWorld drive;
  drive.ask(0.4, 0.0);
  drive.run(seconds(8));
  ASSERT_DOUBLE_EQ(drive.granted.motion.speed_mps, 0.4);
  drive.asks = false;
  const Decision stopped = drive.run(milliseconds(200));
  EXPECT_EQ(stopped.first, Reason::kNoRequest);
  EXPECT_EQ(stopped.granted.speed_mps, 0.0);
  drive.asks = true;
  const Decision first = drive.step();
  EXPECT_NEAR(first.granted.speed_mps, kAcceleration_mps2 * 0.02, 1e-12);
  EXPECT_EQ(first.first, Reason::kAcceleration);
  EXPECT_NEAR(drive.step().granted.speed_mps, kAcceleration_mps2 * 0.04, 1e-12);
}

TEST(Stopping, ALateTickGrantsNoJump) {
  DrivenWorld drive;
  drive.ask(0.4, 0.0);
  drive.run(seconds(8));
  const Granted long_ago{{0.1, 0.0}, drive.now().steady - seconds(2)};
  const Decision decision = decide(drive.now(), drive.world, long_ago, drive.params);
  EXPECT_NEAR(decision.granted.speed_mps, 0.1 + kAcceleration_mps2 * kStepMax_s, 1e-12);
  const Granted future{{0.1, 0.0}, drive.now().steady + seconds(2)};
  EXPECT_NEAR(decide(drive.now(), drive.world, future, drive.params).granted.speed_mps, 0.1, 1e-12);
}

TEST(Stopping, SlowingKeepsTheCurvature) {
  DrivenWorld drive;
  drive.params.speed_max_mps = 0.2;
  drive.ask(0.4, 0.2);
  const Decision decision = drive.run(seconds(10));
  EXPECT_DOUBLE_EQ(decision.granted.speed_mps, 0.2);
  EXPECT_DOUBLE_EQ(decision.granted.turn_rate_radps, 0.1);
  EXPECT_EQ(decision.first, Reason::kSpeedLimit);
  drive.ask(0.1, 4.0);
  EXPECT_DOUBLE_EQ(drive.run(seconds(2)).granted.turn_rate_radps, 2.0);
  EXPECT_DOUBLE_EQ(drive.granted.motion.speed_mps, 0.05);
}

TEST(Stopping, AReversalOfTurnGoesThroughZero) {
  DrivenWorld drive;
  drive.ask(0.0, 1.0);
  drive.run(seconds(2));
  drive.ask(0.0, -1.0);
  EXPECT_NEAR(drive.step().granted.turn_rate_radps, -kTurnAcceleration_radps2 * 0.02, 1e-12);
}

TEST(Stopping, SilenceOfAnyInputStopsWithinItsLimit) {
  struct Silence {
    bool DrivenWorld::*input;
    Duration limit;
    Reason reason;
  };
  for (const Silence& silence :
       {Silence{&DrivenWorld::has_camera, kCameraAge, Reason::kNoCamera},
        Silence{&DrivenWorld::has_odometry, kOdometryAge, Reason::kNoOdometry},
        Silence{&DrivenWorld::has_body, kCreateStateAge, Reason::kNoCreateState},
        Silence{&DrivenWorld::asks, milliseconds(100), Reason::kNoRequest}}) {
    DrivenWorld drive;
    drive.ask(0.3, 0.0);
    drive.run(seconds(9));
    ASSERT_GT(drive.granted.motion.speed_mps, 0.2);
    drive.*silence.input = false;
    drive.run(silence.limit - DrivenWorld::kTick * 2);
    EXPECT_GT(drive.granted.motion.speed_mps, 0.2) << words_of(silence.reason);
    const Decision decision = drive.run(DrivenWorld::kTick * 4);
    EXPECT_EQ(decision.granted.speed_mps, 0.0);
    EXPECT_TRUE(decision.reasons.has(silence.reason)) << words_of(silence.reason);
  }
}

TEST(Stopping, StampsFromTheFutureStopIt) {
  DrivenWorld drive;
  drive.ask(0.3, 0.0);
  drive.run(seconds(4));
  drive.stamp_ahead = milliseconds(500);
  const Decision decision = drive.step();
  EXPECT_EQ(decision.granted.speed_mps, 0.0);
  EXPECT_TRUE(decision.reasons.has(Reason::kClock));
}

TEST(Stopping, OneStampFromTheFutureIsEnough) {
  const std::vector<std::function<void(DrivenWorld&)>> lies = {
      [](DrivenWorld& d) { (void)d.world.hear_odometry(d.now(), d.odometry_sample()); },
      [](DrivenWorld& d) { (void)d.world.hear_view(d.now(), d.view()); },
      [](DrivenWorld& d) {
        (void)d.world.hear_body(d.now(), d.now().wall + d.stamp_ahead, d.body);
      },
      [](DrivenWorld& d) {
        (void)d.world.hear_frame(d.now(), d.now().wall + d.stamp_ahead, DrivenWorld::camera());
      },
      [](DrivenWorld& d) {
        d.world.tick({d.now().steady, d.now().wall + milliseconds(500)});
      }};
  for (const auto& lie : lies) {
    DrivenWorld drive;
    drive.ask(0.3, 0.0);
    drive.run(seconds(4));
    drive.stamp_ahead = milliseconds(500);
    lie(drive);
    drive.stamp_ahead = {};
    const Decision decision = drive.step();
    EXPECT_EQ(decision.granted.speed_mps, 0.0);
    EXPECT_TRUE(decision.reasons.has(Reason::kClock));
  }
}

TEST(Stopping, ViewsWithoutTheirFramesStopIt) {
  DrivenWorld drive;
  drive.ask(0.3, 0.0);
  drive.run(seconds(4));
  drive.has_frames = false;
  const Decision decision = drive.run(kCameraAge + milliseconds(60));
  EXPECT_EQ(decision.granted.speed_mps, 0.0);
  EXPECT_TRUE(decision.reasons.has(Reason::kNoCamera));
}

TEST(Stopping, AnEmergencyStopStaysUntilItIsReset) {
  DrivenWorld drive;
  drive.ask(0.3, 0.0);
  drive.run(seconds(4));
  drive.world.estop.press(drive.now(), false);
  EXPECT_EQ(drive.step().first, Reason::kEstop);
  EXPECT_EQ(drive.run(seconds(5)).granted.speed_mps, 0.0);
  const std::int64_t latch_id = drive.world.estop.latch_id();
  EXPECT_EQ(drive.world.estop.reset(drive.now(), latch_id, drive.world.is_calm(drive.now())),
            ResetResult::kNotCalm);
  drive.ask(0.0, 0.0);
  drive.step();
  EXPECT_EQ(drive.world.estop.reset(drive.now(), latch_id, drive.world.is_calm(drive.now())),
            ResetResult::kReset);
  drive.ask(0.3, 0.0);
  EXPECT_NEAR(drive.step().granted.speed_mps, kAcceleration_mps2 * 0.02, 1e-12);
}

TEST(Stopping, RemembersNoLongerThanAWalkerNeeds) {
  DrivenWorld drive;
  drive.ask(0.3, 0.0);
  drive.run(seconds(6));
  drive.ask(0.0, 0.0);
  drive.run(seconds(11));
  drive.ask(0.3, 0.0);
  EXPECT_DOUBLE_EQ(drive.run(milliseconds(600)).granted.speed_mps, kCreep_mps);
}

}  // namespace
}  // namespace roomwise::safety
