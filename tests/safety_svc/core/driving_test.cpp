// decide() while a robot drives: what is seen, remembered, felt and asked.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "services/safety_svc/core/stopping.h"
#include "tests/safety_svc/support/driven_world.h"

namespace roomwise::safety {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

TEST(Driving, OnOpenFloorWhatIsAskedIsGranted) {
  DrivenWorld drive;
  drive.ask(0.5, 0.2);
  const Decision decision = drive.run(seconds(12));
  EXPECT_DOUBLE_EQ(decision.granted.speed_mps, 0.5);
  EXPECT_DOUBLE_EQ(decision.granted.turn_rate_radps, 0.2);
  EXPECT_TRUE(decision.reasons.is_empty());
  EXPECT_EQ(decision.first, Reason::kAsAsked);
}

TEST(Driving, WhatIsAskedSlowerThanAMillimetreASecondIsATurnOnTheSpot) {
  DrivenWorld drive;
  drive.ask(0.00099, 0.5);
  Decision decision = drive.run(seconds(1));
  EXPECT_EQ(decision.granted.speed_mps, 0.0);
  EXPECT_DOUBLE_EQ(decision.granted.turn_rate_radps, 0.5);
  drive.ask(0.001, 0.0);
  decision = drive.step();
  EXPECT_DOUBLE_EQ(decision.granted.speed_mps, 0.001);
}

TEST(Driving, WhatTheAccelerationJustAllowsIsAsAsked) {
  DrivenWorld drive;
  drive.ask(0.0, 0.0);
  drive.run(seconds(1));
  drive.ask(0.0, kTurnAcceleration_radps2 * 0.02);
  EXPECT_TRUE(drive.step().reasons.is_empty());
  drive.ask(0.0, kTurnAcceleration_radps2 * 0.041);
  EXPECT_TRUE(drive.step().reasons.has(Reason::kAcceleration));
}

TEST(Driving, BeginsWithACreepOverFloorItHasNotSeen) {
  DrivenWorld drive;
  drive.ask(0.5, 0.0);
  const Decision decision = drive.run(seconds(1));
  EXPECT_DOUBLE_EQ(decision.granted.speed_mps, kCreep_mps);
  EXPECT_EQ(decision.first, Reason::kUnknown);
}

TEST(Driving, WhenOdometryBeginsAnewInMotionItStopsAndCreepsOn) {
  DrivenWorld drive;
  drive.ask(0.3, 0.0);
  ASSERT_GT(drive.run(seconds(12)).granted.speed_mps, 0.29);
  ++drive.odometry_resets;
  drive.T_odom_robot = {};
  EXPECT_EQ(drive.step().granted.speed_mps, 0.0) << "what it knew is forgotten";
  EXPECT_GT(drive.run(seconds(12)).granted.speed_mps, 0.29);
}

TEST(Driving, StopsBeforeAWallAndSaysWhy) {
  DrivenWorld drive;
  for (int i = -20; i <= 20; ++i) drive.discs.push_back({{2.5, 0.1 * i}, 0.1});
  drive.ask(0.5, 0.0);
  const Decision decision = drive.run(seconds(20));
  EXPECT_EQ(decision.granted.speed_mps, 0.0);
  EXPECT_GT(drive.clearance_m(), 0.02);
  EXPECT_LT(drive.clearance_m(), 0.45);
  EXPECT_TRUE(decision.first == Reason::kUnknown || decision.first == Reason::kRemembered)
      << words_of(decision.first);
}

TEST(Driving, StopsBeforeAPostInTheBlindZoneItSawBefore) {
  DrivenWorld drive;
  drive.discs = {{{2.0, 0.05}, 0.04}};
  drive.ask(0.4, 0.0);
  const Decision decision = drive.run(seconds(20));
  EXPECT_EQ(decision.granted.speed_mps, 0.0);
  EXPECT_GT(drive.clearance_m(), 0.0);
  EXPECT_EQ(decision.first, Reason::kRemembered) << words_of(decision.first);
  EXPECT_GT(decision.corridor.p_robot_end_m.x(), 0.17);
}

TEST(Driving, PassesAPostBesideItsWay) {
  DrivenWorld drive;
  drive.discs = {{{2.0, 0.4}, 0.04}};
  drive.ask(0.4, 0.0);
  drive.run(seconds(14));
  EXPECT_GT(drive.T_odom_robot.x_m, 2.4);
}

TEST(Driving, AnArcIsSweptAsAnArc) {
  DrivenWorld drive;
  drive.discs = {{{1.0, 1.0}, 0.05}};
  drive.ask(0.3, 0.3);  // radius 1 m: leads through (1, 1)
  const Decision decision = drive.run(seconds(20));
  EXPECT_EQ(decision.granted.speed_mps, 0.0);
  EXPECT_GT(drive.clearance_m(), 0.0);
  DrivenWorld straight;
  straight.discs = drive.discs;
  straight.ask(0.3, 0.0);
  straight.run(seconds(12));
  EXPECT_GT(straight.T_odom_robot.x_m, 2.0);
}

/// What ends the corridor if this is asked for, and was granted so far.
Reason end_of_corridor(DrivenWorld& drive, double speed_mps, double turn_rate_radps) {
  drive.ask(speed_mps, turn_rate_radps);
  drive.hear_request();
  const Granted before{drive.request, drive.now().steady};
  return decide(drive.now(), drive.world, before, drive.params).corridor.end;
}

TEST(Driving, AnArcMeetsWhatStandsBesideTheStraightWay) {
  DrivenWorld drive;
  drive.discs = {{{1.6, 0.35}, 0.05}};
  drive.ask(0.5, 0.0);
  while (drive.T_odom_robot.x_m < 1.2) drive.step();  // the post is 0.4 m ahead, 0.35 m to the left
  EXPECT_EQ(end_of_corridor(drive, 0.5, 0.0), Reason::kAsAsked);
  EXPECT_NE(end_of_corridor(drive, 0.5, 1.0), Reason::kAsAsked) << "the post, and what it hides";
  EXPECT_EQ(end_of_corridor(drive, 0.5, -1.0), Reason::kAsAsked);
}

TEST(Driving, ATightArcPassesWhatStandsAhead) {
  DrivenWorld drive;
  drive.discs = {{{2.0, -0.03}, 0.05}};
  drive.ask(0.3, 0.0);
  while (drive.T_odom_robot.x_m < 1.63) drive.step();  // its rim 0.15 m before the post
  EXPECT_NE(end_of_corridor(drive, 0.05, 0.0), Reason::kAsAsked);
  EXPECT_EQ(end_of_corridor(drive, 0.05, 2.0), Reason::kAsAsked) << "within 5 cm";
}

TEST(Driving, BeforeWhatItKnowsItDoesNotSpeakOfTheUnknown) {
  DrivenWorld drive;
  drive.ask(0.3, 0.0);
  ASSERT_GT(drive.run(seconds(12)).granted.speed_mps, 0.29);
  drive.body.bump = true;
  drive.step();  // something stands on floor seen free
  drive.body.bump = false;
  drive.step();
  const Granted fast{{0.3, 0.0}, drive.now().steady};
  const Decision decision = decide(drive.now(), drive.world, fast, drive.params);
  EXPECT_TRUE(decision.reasons.has(Reason::kRemembered));
  EXPECT_FALSE(decision.reasons.has(Reason::kUnknown));
}

TEST(Driving, WhatCannotBeMeasuredIsNotFree) {
  DrivenWorld drive;
  drive.discs = {{{1.8, 0.0}, 0.1}};
  drive.dark_within_m = 1.2;  // a mirror: no reading at all once near
  drive.ask(0.4, 0.0);
  const Decision decision = drive.run(seconds(12));
  EXPECT_EQ(decision.granted.speed_mps, 0.0);
  EXPECT_EQ(decision.first, Reason::kUnknown);
  EXPECT_GT(drive.clearance_m(), 0.5);
}

TEST(Driving, TurnsOnTheSpotWhereItCannotGoAhead) {
  DrivenWorld drive;
  drive.discs = {{{0.35, 0.0}, 0.1}};
  drive.ask(0.0, 1.0);
  EXPECT_DOUBLE_EQ(drive.run(seconds(2)).granted.turn_rate_radps, 1.0);
}

TEST(Driving, TurningOnTheSpotLooksAtNoCorridor) {
  DrivenWorld drive;
  drive.ask(0.3, 0.0);
  ASSERT_GT(drive.run(seconds(4)).corridor.free_m, 0.1);
  drive.ask(0.0, 0.5);
  const CorridorView corridor = drive.run(seconds(1)).corridor;
  EXPECT_EQ(corridor.free_m, 0.0);
  EXPECT_EQ(corridor.end, Reason::kAsAsked);
}

TEST(Driving, TheWayBackIsThatOfTheArcAskedForOrStraight) {
  DrivenWorld drive;
  drive.ask(0.3, 0.0);
  drive.run(seconds(8));
  const auto way_back_m = [&](double speed_mps, double turn_rate_radps) {
    drive.ask(speed_mps, turn_rate_radps);
    drive.hear_request();
    return decide(drive.now(), drive.world, drive.granted, drive.params).reverse_way_m;
  };
  EXPECT_NEAR(way_back_m(-0.1, 0.0), kReverse_m, 0.021);
  EXPECT_LT(way_back_m(-0.1, 0.8), 0.2) << "leaves the track";
  EXPECT_NEAR(way_back_m(0.0, 0.8), kReverse_m, 0.021);
  EXPECT_NEAR(way_back_m(0.1, 0.8), kReverse_m, 0.021);
}

TEST(Driving, GoesBackAsFarAsItCameAndNoFarther) {
  DrivenWorld drive;
  drive.ask(0.3, 0.0);
  drive.run(seconds(4));
  const double came_m = drive.T_odom_robot.x_m;
  ASSERT_GT(came_m, 0.3);
  drive.ask(-0.3, 0.0);
  EXPECT_DOUBLE_EQ(drive.run(seconds(1)).granted.speed_mps, -kCreep_mps);
  const Decision decision = drive.run(seconds(20));
  EXPECT_NEAR(decision.granted.speed_mps, 0.0, 0.011);
  EXPECT_TRUE(decision.reasons.has(Reason::kReverse));
  EXPECT_GT(drive.T_odom_robot.x_m, -0.03);
  EXPECT_LT(drive.T_odom_robot.x_m, came_m - 0.2);
}

TEST(Driving, NeverBacksOffFromWhereItStarted) {
  DrivenWorld drive;
  drive.ask(-0.3, 0.0);
  drive.run(seconds(5));
  EXPECT_GT(drive.T_odom_robot.x_m, -0.04);
}

TEST(Driving, AfterTurningTheWayBackIsNoLongerWhereItCameFrom) {
  DrivenWorld drive;
  drive.ask(0.3, 0.0);
  drive.run(seconds(4));
  drive.ask(0.0, 1.0);
  drive.run(milliseconds(1600));
  const Pose2 before = drive.T_odom_robot;
  drive.ask(-0.3, 0.0);
  drive.run(seconds(5));
  EXPECT_LT((drive.T_odom_robot.position_m() - before.position_m()).norm(), 0.05);
}

TEST(Driving, ABumpStopsAllButTheWayBackAndIsRemembered) {
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

TEST(Driving, ACliffStopsAllButTheWayBack) {
  DrivenWorld drive;
  drive.ask(0.3, 0.0);
  drive.run(seconds(4));
  drive.body.cliff = true;
  EXPECT_EQ(drive.run(milliseconds(200)).first, Reason::kCliff);
  drive.body.cliff = false;
  EXPECT_EQ(drive.run(milliseconds(200)).first, Reason::kDropOff);
}

TEST(Driving, WhatWasFeltForAMomentIsRemembered) {
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

TEST(Driving, TheRobotsSensorsStopIt) {
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

TEST(Driving, NearAWallItCreeps) {
  DrivenWorld drive;
  drive.body.near_wall = true;
  drive.ask(0.3, 0.0);
  const Decision decision = drive.run(seconds(8));
  EXPECT_DOUBLE_EQ(decision.granted.speed_mps, kCreep_mps);
  EXPECT_EQ(decision.first, Reason::kWall);
}

TEST(Driving, RampsUpFromZeroAfterEveryStop) {
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

TEST(Driving, ALateTickGrantsNoJump) {
  DrivenWorld drive;
  drive.ask(0.4, 0.0);
  drive.run(seconds(8));
  const Granted long_ago{{0.1, 0.0}, drive.now().steady - seconds(2)};
  const Decision decision = decide(drive.now(), drive.world, long_ago, drive.params);
  EXPECT_NEAR(decision.granted.speed_mps, 0.1 + kAcceleration_mps2 * kStepMax_s, 1e-12);
  const Granted future{{0.1, 0.0}, drive.now().steady + seconds(2)};
  EXPECT_NEAR(decide(drive.now(), drive.world, future, drive.params).granted.speed_mps, 0.1, 1e-12);
}

TEST(Driving, SlowingKeepsTheCurvature) {
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

TEST(Driving, AReversalOfTurnGoesThroughZero) {
  DrivenWorld drive;
  drive.ask(0.0, 1.0);
  drive.run(seconds(2));
  drive.ask(0.0, -1.0);
  EXPECT_NEAR(drive.step().granted.turn_rate_radps, -kTurnAcceleration_radps2 * 0.02, 1e-12);
}

TEST(Driving, SilenceOfAnyInputStopsWithinItsLimit) {
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

TEST(Driving, StampsFromTheFutureStopIt) {
  DrivenWorld drive;
  drive.ask(0.3, 0.0);
  drive.run(seconds(4));
  drive.stamp_ahead = milliseconds(500);
  const Decision decision = drive.step();
  EXPECT_EQ(decision.granted.speed_mps, 0.0);
  EXPECT_TRUE(decision.reasons.has(Reason::kClock));
}

TEST(Driving, OneStampFromTheFutureIsEnough) {
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

TEST(Driving, ViewsWithoutTheirFramesStopIt) {
  DrivenWorld drive;
  drive.ask(0.3, 0.0);
  drive.run(seconds(4));
  drive.has_frames = false;
  const Decision decision = drive.run(kCameraAge + milliseconds(60));
  EXPECT_EQ(decision.granted.speed_mps, 0.0);
  EXPECT_TRUE(decision.reasons.has(Reason::kNoCamera));
}

TEST(Driving, AnEmergencyStopStaysUntilItIsReset) {
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

TEST(Driving, RemembersNoLongerThanAWalkerNeeds) {
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
