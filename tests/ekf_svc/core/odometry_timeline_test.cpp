#include "services/ekf_svc/core/odometry_timeline.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace roomwise::ekf {
namespace {

Time at_ms(int ms) { return time_from_utime(1'000'000 + 1000LL * ms); }

MotionStep step_of(double distance_m, double turn_rad) {
  return arc_step(distance_m, turn_rad, 0.01 * Eigen::Matrix2d::Identity());
}

TEST(OdometryTimeline, TakingInPiecesIsTakingAtOnce) {
  OdometryTimeline pieces, whole;
  for (OdometryTimeline* timeline : {&pieces, &whole}) {
    timeline->restart(at_ms(0));
    timeline->append(at_ms(20), step_of(0.1, 0.2));
    timeline->append(at_ms(50), step_of(0.2, -0.1));
  }
  Pose2 pose;
  for (const int ms : {3, 3, 17, 20, 41, 50}) pose = moved(pose, pieces.take(at_ms(ms)));
  const Pose2 expected = moved(Pose2{}, whole.take(at_ms(50)));
  EXPECT_NEAR(pose.x_m, expected.x_m, 1e-12);
  EXPECT_NEAR(pose.y_m, expected.y_m, 1e-12);
  EXPECT_NEAR(pose.heading_rad, expected.heading_rad, 1e-12);
}

TEST(OdometryTimeline, WhatIsTakenIsNoLongerAhead) {
  OdometryTimeline timeline;
  timeline.restart(at_ms(0));
  timeline.append(at_ms(20), step_of(0.1, 0.0));
  EXPECT_NEAR(timeline.take(at_ms(5)).translation_m.x(), 0.025, 1e-12);
  EXPECT_NEAR(timeline.ahead().translation_m.x(), 0.075, 1e-12);
  EXPECT_EQ(timeline.start(), at_ms(5));
  EXPECT_EQ(timeline.end(), at_ms(20));
}

TEST(OdometryTimeline, TimesOutsideAreABug) {
  OdometryTimeline timeline;
  timeline.restart(at_ms(10));
  EXPECT_THROW(timeline.append(at_ms(10), {}), std::logic_error);
  EXPECT_THROW((void)timeline.take(at_ms(9)), std::logic_error);
  EXPECT_THROW((void)timeline.take(at_ms(11)), std::logic_error);
}

}  // namespace
}  // namespace roomwise::ekf
