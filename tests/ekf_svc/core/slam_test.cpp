// Which landmark a sighting belongs to, and what happens when the gate says no.
#include "services/ekf_svc/core/slam.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace roomwise::ekf {
namespace {

constexpr double kSigma = 0.02;

Sighting sighting_of(const Pose2& robot, const Eigen::Vector2d& landmark, int identity,
                     std::int8_t kind = 0) {
  const Eigen::Vector2d p = transform(inverse(robot), landmark);
  Sighting sighting;
  sighting.polar.range_m = p.norm();
  sighting.polar.bearing_rad = std::atan2(p.y(), p.x());
  sighting.polar.covariance = kSigma * kSigma * Eigen::Matrix2d::Identity();
  sighting.identity = identity;
  sighting.kind = kind;
  return sighting;
}

/// A Slam, and the robot's true pose beside it.
class SlamTest : public testing::Test {
 protected:
  FrameResult look(const std::vector<Sighting>& sightings, bool may_update = true) {
    verdicts_.assign(sightings.size(), Verdict::kMatched);
    return slam_.process(sightings, may_update, verdicts_);
  }
  Sighting see(std::size_t l) const {
    return sighting_of(truth_, landmarks_[l], static_cast<int>(l));
  }
  std::vector<Sighting> see_all() const {
    std::vector<Sighting> all;
    for (std::size_t l = 0; l < landmarks_.size(); ++l) all.push_back(see(l));
    return all;
  }
  void drive(double distance_m, double turn_rad) {
    MotionIncrement motion;
    Eigen::Matrix2d covariance = 1e-5 * Eigen::Matrix2d::Identity();
    motion.append(arc_step(distance_m, turn_rad, covariance));
    truth_ = moved(truth_, motion);
    slam_.predict(motion);
  }
  double position_error_m() const {
    return (slam_.filter().pose().position_m() - truth_.position_m()).norm();
  }

  Slam slam_{[] {
    EkfParams params;
    params.confirm_sightings = 1;
    return params;
  }()};
  Pose2 truth_;
  std::vector<Eigen::Vector2d> landmarks_{{3.0, 0.0}, {2.0, 2.0}, {2.5, -1.5}, {1.0, 3.0}};
  std::vector<Verdict> verdicts_;
};

TEST_F(SlamTest, AFrameNeverAddsAndUpdatesTheSameLandmark) {
  const FrameResult first = look({see(0), see(0), see(1)});
  EXPECT_EQ(first.added, 2);
  EXPECT_EQ(first.matched, 0);
  EXPECT_EQ(verdicts_[1], Verdict::kTaken);
  EXPECT_EQ(slam_.filter().landmark(0).times_seen, 1);
}

TEST_F(SlamTest, KnownIdentityIsMatchedAgain) {
  look(see_all());
  drive(0.1, 0.05);
  EXPECT_EQ(look(see_all()).matched, 4);
  EXPECT_EQ(slam_.filter().landmark_count(), 4U);
  EXPECT_EQ(slam_.filter().landmark(2).times_seen, 2);
}

TEST_F(SlamTest, UnknownIdentityTwoGates) {
  const Eigen::Vector2d mapped(3.0, 0.0);
  look({sighting_of(truth_, mapped, -1)});
  const double sigma =
      std::sqrt(slam_.filter().landmark_covariance_m2(0)(0, 0) + kSigma * kSigma + 0.015 * 0.015);
  const auto offset = [&](double sigmas) {
    return sighting_of(truth_, mapped + Eigen::Vector2d(sigmas * sigma, 0.0), -1);
  };
  look({offset(2.9)}, false);
  EXPECT_EQ(verdicts_[0], Verdict::kHeld);
  look({offset(4.0)});
  EXPECT_EQ(verdicts_[0], Verdict::kAmbiguous);
  EXPECT_EQ(slam_.filter().landmark_count(), 1U);
  look({offset(5.2)});
  EXPECT_EQ(verdicts_[0], Verdict::kAdded);
}

// A frame tells of each thing once.
TEST_F(SlamTest, OnlyTheNearestSightingTakesALandmarkAndTheOtherIsOfAnother) {
  look({sighting_of(truth_, {3.0, 0.0}, -1)});
  look({sighting_of(truth_, {3.02, 0.0}, -1), sighting_of(truth_, {3.0, 0.0}, -1)});
  EXPECT_EQ(verdicts_[0], Verdict::kAdded);
  EXPECT_EQ(verdicts_[1], Verdict::kMatched);
  EXPECT_EQ(slam_.filter().landmark_count(), 2U);
}

TEST_F(SlamTest, WhatIsInDoubtBetweenALandmarkAndNothingStaysInDoubtBesideAnother) {
  look({sighting_of(truth_, {3.0, 0.0}, -1), sighting_of(truth_, {3.0, 1.0}, -1)});
  const double sigma =
      std::sqrt(slam_.filter().landmark_covariance_m2(0)(0, 0) + kSigma * kSigma + 0.015 * 0.015);
  look({sighting_of(truth_, {3.0 + 4.0 * sigma, 0.0}, -1), sighting_of(truth_, {3.0, 1.0}, -1)});
  EXPECT_EQ(verdicts_[0], Verdict::kAmbiguous);
  EXPECT_EQ(verdicts_[1], Verdict::kMatched);
}

// Neighbours a single sighting can hardly tell apart must not make strangers of both.
TEST_F(SlamTest, ALandmarkWithANeighbourWithinTheNoiseIsKnownAgainAfterALongWay) {
  const std::vector<Eigen::Vector2d> places{{3.0, 0.0}, {3.0, 0.15}, {1.0, 3.0}};
  std::vector<Sighting> all;
  for (const Eigen::Vector2d& place : places) {
    all.push_back(sighting_of(truth_, place, -1));
    all.back().polar.covariance = Eigen::Vector2d(0.01, 0.001).asDiagonal();
  }
  for (int i = 0; i < 20; ++i) look(all);
  ASSERT_EQ(slam_.filter().landmark_count(), 3U);
  drive(4.5, 0.0);
  drive(-4.5, 0.0);
  look({all[0], all[2]});
  EXPECT_EQ(verdicts_[0], Verdict::kMatched);
  EXPECT_EQ(verdicts_[1], Verdict::kMatched);
  EXPECT_EQ(slam_.filter().landmark_count(), 3U);
}

TEST_F(SlamTest, AnotherKindIsAnotherLandmark) {
  look({sighting_of(truth_, {3.0, 0.0}, -1, 1)});
  look({sighting_of(truth_, {3.0, 0.0}, -1, 2)});
  EXPECT_EQ(verdicts_[0], Verdict::kAdded);
}

TEST_F(SlamTest, AnotherColourIsNotTheSameLandmark) {
  Sighting red = sighting_of(truth_, {3.0, 0.0}, -1);
  red.signature = {1.0, 0.0, 0.01};
  Sighting blue = red;
  blue.signature = {-1.0, 1.0, 0.01};
  look({red});
  look({blue});
  EXPECT_EQ(verdicts_[0], Verdict::kAdded);
  look({red});
  EXPECT_EQ(verdicts_[0], Verdict::kMatched);
}

TEST_F(SlamTest, MovingThingsAreIgnored) {
  Sighting person = see(0);
  person.moving = true;
  const FrameResult result = look({person});
  EXPECT_EQ(result.added, 0);
  EXPECT_EQ(result.rejected, 0);
  EXPECT_EQ(verdicts_[0], Verdict::kMoving);
}

TEST_F(SlamTest, OneMisreadLandmarkIsRefusedAndTheRestUsed) {
  look(see_all());
  for (int i = 0; i < 30; ++i) {
    drive(0.05, 0.0);
    std::vector<Sighting> seen = see_all();
    if (i % 3 == 0) seen[1] = sighting_of(truth_, {-1.0, -2.0}, 1);  // a robot taken for it
    EXPECT_FALSE(look(seen).pose_widened);
    if (i % 3 == 0) {
      EXPECT_EQ(verdicts_[1], Verdict::kOutlier);
    }
  }
  EXPECT_LT(position_error_m(), 0.01);
}

TEST_F(SlamTest, APushedRobotIsFoundAgain) {
  look(see_all());
  drive(0.1, 0.0);
  look(see_all());
  truth_ = compose(truth_, {-0.3, 0.4, 0.5});  // no wheel turned
  bool widened = false;
  for (int i = 0; i < 30; ++i) {
    drive(0.03, 0.0);
    widened = look({see(static_cast<std::size_t>(i) % 4)}).pose_widened || widened;
  }
  EXPECT_TRUE(widened);
  EXPECT_LT(position_error_m(), 0.15);
  EXPECT_EQ(slam_.filter().landmark_count(), 4U);
}

TEST_F(SlamTest, ALandmarkBegunByAMisreadingIsReplaced) {
  std::vector<Sighting> seen = see_all();
  seen[3] = sighting_of(truth_, {-2.0, -2.0}, 3);
  look(seen);
  bool replaced = false;
  for (int i = 0; i < 10; ++i) {
    drive(0.05, 0.0);
    look(see_all());
    replaced = replaced || verdicts_[3] == Verdict::kReplaced;
  }
  EXPECT_TRUE(replaced);
  EXPECT_LT(position_error_m(), 0.02);
  for (std::size_t l = 0; l < slam_.filter().landmark_count(); ++l) {
    const auto identity = static_cast<std::size_t>(slam_.filter().landmark(l).identity);
    EXPECT_LT((slam_.filter().landmark_position_m(l) - landmarks_[identity]).norm(), 0.1);
  }
}

TEST_F(SlamTest, MoreMatchesThanOneUpdateTakesAreAllUsed) {
  landmarks_.clear();
  for (int i = 0; i < 100; ++i) landmarks_.emplace_back(1.0 + 0.1 * i, 0.05 * i - 2.0);
  EXPECT_EQ(look(see_all()).added, 100);
  drive(0.05, 0.02);
  EXPECT_EQ(look(see_all()).matched, 100);
}

TEST_F(SlamTest, AFullMapRefusesPolitely) {
  EkfParams params;
  params.landmark_budget = 3;
  Slam small(params);
  const std::vector<Sighting> seen = see_all();
  std::vector<Verdict> verdicts(seen.size());
  const FrameResult result = small.process(seen, true, verdicts);
  EXPECT_EQ(result.added, 3);
  EXPECT_EQ(result.rejected, 1);
  EXPECT_EQ(verdicts[3], Verdict::kBudgetFull);
}

TEST_F(SlamTest, NumbersThatCannotBeAreRefusedByName) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  std::vector<Sighting> bad(9, see(0));
  bad[0].polar.range_m = kNan;
  bad[1].polar.range_m = -1.0;
  bad[2].polar.range_m = 1e300;
  bad[3].polar.bearing_rad = kInf;
  bad[4].polar.bearing_rad = 1e9;
  bad[5].polar.covariance(0, 1) = bad[5].polar.covariance(1, 0) = 1.0;
  bad[6].polar.covariance(1, 1) = 0.0;
  bad[7].polar.covariance(0, 0) = 1e300;
  bad[8].polar.covariance(0, 1) = kNan;
  const FrameResult result = look(bad);
  EXPECT_EQ(result.rejected, 9);
  EXPECT_EQ(slam_.filter().landmark_count(), 0U);
  const std::vector<Verdict> expected{
      Verdict::kNotFinite,         Verdict::kRangeInvalid,      Verdict::kRangeInvalid,
      Verdict::kNotFinite,         Verdict::kBearingInvalid,    Verdict::kCovarianceInvalid,
      Verdict::kCovarianceInvalid, Verdict::kCovarianceInvalid, Verdict::kNotFinite};
  EXPECT_EQ(verdicts_, expected);
}

}  // namespace
}  // namespace roomwise::ekf
