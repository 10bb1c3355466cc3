// What was seen but is not sure enough to be in the map.
#include "services/ekf_svc/core/tentative_landmarks.h"

#include <gtest/gtest.h>

#include <vector>

#include "services/ekf_svc/core/slam.h"

namespace roomwise::ekf {
namespace {

constexpr double kSeenSigma = 0.02;

/// A Slam that wants three sightings, and the robot's true pose beside it.
class TentativeLandmarksTest : public testing::Test {
 protected:
  Sighting see(const Eigen::Vector2d& p_map_m) const {
    const Eigen::Vector2d p = transform(inverse(truth_), p_map_m);
    Sighting sighting;
    sighting.polar.range_m = p.norm();
    sighting.polar.bearing_rad = std::atan2(p.y(), p.x());
    sighting.polar.covariance = kSeenSigma * kSeenSigma * Eigen::Matrix2d::Identity();
    return sighting;
  }
  FrameResult look(const std::vector<Eigen::Vector2d>& p_map_m) {
    std::vector<Sighting> sightings;
    for (const Eigen::Vector2d& p_m : p_map_m) sightings.push_back(see(p_m));
    verdicts_.assign(sightings.size(), Verdict::kMatched);
    return slam_.process(sightings, true, verdicts_);
  }
  /// Odometry says so; in truth the robot turns by `slip_rad` more.
  void drive(double distance_m, double slip_rad = 0.0) {
    Eigen::Matrix2d covariance = 1e-6 * Eigen::Matrix2d::Identity();
    covariance(1, 1) += slip_rad * slip_rad;
    MotionIncrement told;
    told.append(arc_step(distance_m, 0.0, covariance));
    MotionIncrement true_motion;
    true_motion.append(arc_step(distance_m, slip_rad, covariance));
    truth_ = moved(truth_, true_motion);
    slam_.predict(told);
  }
  const SlamFilter& filter() const { return slam_.filter(); }

  Slam slam_{EkfParams{}};
  Pose2 truth_;
  std::vector<Verdict> verdicts_;
};

TEST_F(TentativeLandmarksTest, IsInTheMapWhenSeenThreeTimesFromElsewhere) {
  const std::vector<Eigen::Vector2d> things{{3.0, 0.5}};
  for (int sightings = 1; sightings <= 5; ++sightings) {
    EXPECT_EQ(look(things).added, 0) << "from one place, however often";
    EXPECT_EQ(verdicts_[0], Verdict::kTentative);
    EXPECT_EQ(filter().mapped_count(), 0U);
  }
  drive(0.12);
  EXPECT_EQ(look(things).added, 1);
  EXPECT_EQ(filter().mapped_count(), 1U);
  drive(0.05);
  EXPECT_EQ(look(things).matched, 1);
  EXPECT_EQ(filter().landmark_count(), 1U);
}

TEST_F(TentativeLandmarksTest, CorrectsNothingBeforeItIsSure) {
  const std::vector<Eigen::Vector2d> things{{3.0, 0.5}};
  look(things);
  drive(0.05, 0.01);
  const Pose2 pose = filter().pose();
  const Eigen::Matrix3d covariance = filter().pose_covariance();
  look(things);
  EXPECT_EQ(filter().pose().heading_rad, pose.heading_rad);
  EXPECT_EQ(filter().pose_covariance(), covariance);
}

TEST_F(TentativeLandmarksTest, MeasuresWhatTheRobotDidSinceItsFirstSighting) {
  const std::vector<Eigen::Vector2d> things{{3.0, 0.5}, {2.0, -0.6}, {3.5, 1.2}};
  look(things);
  drive(0.06, 0.05);
  look(things);
  drive(0.06);
  EXPECT_GT(std::abs(filter().pose().heading_rad - truth_.heading_rad), 0.04);
  EXPECT_EQ(look(things).added, 3);
  EXPECT_NEAR(filter().pose().heading_rad, truth_.heading_rad, 0.005);
}

TEST_F(TentativeLandmarksTest, IsForgottenWhenNotSeenAgain) {
  look({{3.0, 0.5}});
  EXPECT_EQ(filter().landmark_count(), 1U);
  drive(1.0);
  look({});
  EXPECT_EQ(filter().landmark_count(), 1U);
  drive(1.1);
  look({});
  EXPECT_EQ(filter().landmark_count(), 0U);
}

TEST_F(TentativeLandmarksTest, AnyNumberOfThemStaysWithinBounds) {
  for (int frame = 0; frame < 10; ++frame) {
    std::vector<Eigen::Vector2d> things;  // none of them twice
    for (int i = 0; i < 1000; ++i) things.emplace_back(1.0 + 0.1 * frame, -10.0 + 0.02 * i);
    look(things);
    EXPECT_LE(filter().landmark_count(), 256U);
    EXPECT_EQ(verdicts_.front(), Verdict::kTentative) << "what is new has room";
    EXPECT_EQ(verdicts_.back(), Verdict::kBudgetFull);
  }
}

TEST_F(TentativeLandmarksTest, IsNotSaved) {
  look({{3.0, 0.5}, {2.0, -0.6}, {3.5, 1.2}});
  drive(0.06);
  look({{3.0, 0.5}, {3.5, 1.2}});
  drive(0.06);
  look({{3.0, 0.5}, {3.5, 1.2}});
  ASSERT_EQ(filter().mapped_count(), 2U);
  ASSERT_EQ(filter().landmark_count(), 3U);
  MapSnapshot map;
  filter().save(map);
  ASSERT_EQ(map.landmarks.size(), 2U);
  ASSERT_EQ(map.covariance_m2.size(), 10U);
  const std::size_t first = SlamFilter::landmark_index(0), last = SlamFilter::landmark_index(2);
  EXPECT_EQ(map.positions_m[1], filter().landmark_position_m(2));
  EXPECT_EQ(map.covariance(0, 3), filter().covariance(first, last + 1));
  EXPECT_EQ(map.covariance(3, 3), filter().covariance(last + 1, last + 1));
}

}  // namespace
}  // namespace roomwise::ekf
