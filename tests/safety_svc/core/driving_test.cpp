// decide() while a robot drives: what is seen, remembered, felt and asked.
#include <gtest/gtest.h>

#include <cmath>

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
  while (drive.T_odom_robot.x_m < 1.66) drive.step();  // its rim 0.12 m before the post
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

}  // namespace
}  // namespace roomwise::safety
