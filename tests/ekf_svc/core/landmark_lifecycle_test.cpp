#include "services/ekf_svc/core/landmark_lifecycle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "services/ekf_svc/core/slam.h"

namespace roomwise::ekf {
namespace {

Sighting seen_at(const Pose2& robot, const Eigen::Vector2d& place) {
  const Eigen::Vector2d p = transform(inverse(robot), place);
  Sighting sighting;
  sighting.polar.range_m = p.norm();
  sighting.polar.bearing_rad = std::atan2(p.y(), p.x());
  sighting.polar.covariance = 1e-4 * Eigen::Matrix2d::Identity();
  return sighting;
}

class Lifecycle : public testing::Test {
 protected:
  Lifecycle() {
    params_.confirm_sightings = 1;
    params_.update_travel_m = 0.0;
  }
  /// Rolls 2 cm on and looks at the places given, and at a wall: nearer from straight ahead to the
  /// right if that is said.
  void look(Slam& slam, const std::vector<Eigen::Vector2d>& places, double wall_m = 0.0,
            float to_the_right_m = 0.0F) {
    MotionIncrement motion;
    motion.append(arc_step(0.02, 0.0, 1e-8 * Eigen::Matrix2d::Identity()));
    robot_ = moved(robot_, motion);
    slam.predict(motion);
    std::vector<Sighting> sightings;
    for (const auto& place : places) sightings.push_back(seen_at(robot_, place));
    std::vector<Verdict> verdicts(sightings.size());
    std::vector<float> beams(100, static_cast<float>(wall_m));
    if (to_the_right_m != 0.0F) std::fill_n(beams.begin(), 49, to_the_right_m);
    const VirtualScan scan{-0.5, 0.01, beams};
    slam.process(sightings, true, verdicts, wall_m > 0.0 ? scan : VirtualScan{});
  }

  EkfParams params_;
  Pose2 robot_;
  const Eigen::Vector2d chair_{2.0, 0.0};
  const Eigen::Vector2d door_{2.5, 0.6};
};

TEST_F(Lifecycle, WhatIsLookedThroughGoes) {
  Slam slam(params_);
  for (int i = 0; i < 6; ++i) look(slam, {chair_, door_}, 4.0);
  ASSERT_EQ(slam.filter().landmark_count(), 2U);
  for (int i = 0; i < 11; ++i) look(slam, {door_}, 4.0);  // 6 sightings and 4 more to be sure
  ASSERT_EQ(slam.filter().landmark_count(), 1U);
  EXPECT_LT((slam.filter().landmark_position_m(0) - door_).norm(), 0.05);
}

TEST_F(Lifecycle, WhatIsHiddenStays) {
  Slam slam(params_);
  for (int i = 0; i < 6; ++i) look(slam, {chair_, door_}, 4.0);
  for (int i = 0; i < 30; ++i) look(slam, {door_}, 0.9);  // somebody stands before it
  EXPECT_EQ(slam.filter().landmark_count(), 2U);
}

TEST_F(Lifecycle, WhatStandsAtTheEdgeOfSomethingNearIsNotLookedThrough) {
  Slam slam(params_);
  for (int i = 0; i < 6; ++i) look(slam, {chair_, door_}, 4.0);
  for (int i = 0; i < 30; ++i) look(slam, {door_}, 4.0, 0.9F);  // to the chair's right: hidden
  EXPECT_EQ(slam.filter().landmark_count(), 2U);
}

TEST_F(Lifecycle, WhatNoBeamTellsOfStays) {
  Slam slam(params_);
  for (int i = 0; i < 6; ++i) look(slam, {chair_, door_}, 4.0);
  for (int i = 0; i < 30; ++i) look(slam, {door_}, 4.0, std::nanf(""));
  EXPECT_EQ(slam.filter().landmark_count(), 2U);
}

TEST_F(Lifecycle, WithoutAScanALandmarkBehindIsEvidence) {
  Slam slam(params_);
  for (int i = 0; i < 6; ++i) look(slam, {chair_, door_});
  for (int i = 0; i < 20; ++i) look(slam, {door_, {3.2, 0.0}});
  EXPECT_EQ(slam.filter().landmark_count(), 2U);  // the door and what is behind the chair
  Slam other(params_);
  robot_ = {};
  for (int i = 0; i < 6; ++i) look(other, {chair_, door_});
  for (int i = 0; i < 20; ++i) look(other, {door_});
  EXPECT_EQ(other.filter().landmark_count(), 2U);  // nobody looked through the chair
}

TEST(LostMonitor, SaysLostOnlyWhenManyLandmarksAreMissing) {
  LostMonitor one, many;
  for (int i = 0; i < 100; ++i) {
    one.record(1, false);
    many.record(i % 7, i % 10 == 0);
  }
  EXPECT_FALSE(one.says_lost());
  EXPECT_TRUE(many.says_lost());
  many.clear();
  EXPECT_FALSE(many.says_lost());
}

}  // namespace
}  // namespace roomwise::ekf
