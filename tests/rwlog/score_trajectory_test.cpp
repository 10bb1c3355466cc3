#include "logs/tools/score_trajectory.h"

#include <gtest/gtest.h>

#include "tests/rwlog/poses.h"

namespace roomwise {
namespace {

RC_GTEST_PROP(ScoreTrajectory, TruthAgainstItselfIsZero, ()) {
  const Trajectory truth = *any_trajectory(1);
  const auto score = score_trajectory(truth, truth);
  RC_ASSERT(score->poses == truth.size());
  RC_ASSERT(score->ate_raw_m < 1e-9);
  RC_ASSERT(score->ate_aligned_m < 1e-9);
  RC_ASSERT(score->heading_rmse_rad < 1e-9);
}

RC_GTEST_PROP(ScoreTrajectory, DoesNotDependOnTheMapFrame, ()) {
  const Trajectory truth = *any_trajectory(3);
  Trajectory estimate = truth;
  for (TimedPose2& timed : estimate) {
    timed.pose.x_m += 0.1 * std::sin(static_cast<double>(timed.utime));
  }
  const auto score = score_trajectory(estimate, truth);
  const auto elsewhere = score_trajectory(moved(*any_pose(), estimate), truth);
  RC_ASSERT(std::abs(score->ate_raw_m - elsewhere->ate_raw_m) < 1e-9);
  RC_ASSERT(std::abs(score->ate_aligned_m - elsewhere->ate_aligned_m) < 1e-9);
}

RC_GTEST_PROP(ScoreTrajectory, TurningAboutTheStartChangesRawNotAligned, ()) {
  const Trajectory truth = *any_trajectory(3);
  const Pose2 start = truth.front().pose;
  RC_PRE((truth.back().pose.position_m() - start.position_m()).norm() > 0.5);
  // Turned about its first position, but keeping the first heading: a filter that starts wrong.
  const Pose2 turn = compose(compose(start, Pose2{0, 0, 0.2}), inverse(start));
  Trajectory estimate = moved(turn, truth);
  estimate.front() = truth.front();
  const auto score = score_trajectory(estimate, truth);
  RC_ASSERT(score->ate_raw_m > 0.01);
  RC_ASSERT(score->ate_aligned_m < 1e-9);
}

TEST(ScoreTrajectory, HandComputedErrors) {
  // Truth on a line; the estimate zigzags by 0.1 m and looks 0.05 rad to the left.
  Trajectory truth;
  Trajectory estimate;
  for (int i = 0; i < 4; ++i) {
    const double side = i == 0 || i == 3 ? 0.1 : -0.1;
    truth.push_back({i * 100'000, {double(i), 0.0, 0.0}});
    estimate.push_back({i * 100'000, {double(i), side, 0.05}});
  }
  const auto score = score_trajectory(estimate, truth);
  EXPECT_NEAR(score->ate_aligned_m, 0.1, 1e-12);
  EXPECT_NEAR(score->heading_rmse_rad, 0.05, 1e-12);
}

TEST(ScoreTrajectory, HeadingErrorsAcrossHalfATurnAreSmall) {
  const Trajectory truth{{0, {0, 0, 3.1}}, {100'000, {1, 0, 3.1}}};
  const Trajectory estimate{{0, {0, 0, -3.1}}, {100'000, {1, 0, -3.1}}};
  EXPECT_NEAR(score_trajectory(estimate, truth)->heading_rmse_rad, 2 * std::numbers::pi - 6.2,
              1e-12);
}

TEST(ScoreTrajectory, OnlyWhereTruthExists) {
  const Trajectory truth{{1'000'000, {0, 0, 0}}, {1'500'000, {1, 0, 0}}, {9'000'000, {5, 0, 0}}};
  const Trajectory estimate{{0, {70, 0, 0}},           // before truth
                            {1'250'000, {0.5, 0, 0}},  // between
                            {5'000'000, {70, 0, 0}},   // in a gap
                            {9'000'001, {70, 0, 0}}};  // after
  const auto score = score_trajectory(estimate, truth);
  EXPECT_EQ(score->poses, 1U);
  EXPECT_NEAR(score->ate_raw_m, 0.0, 1e-12);
  EXPECT_FALSE(score_trajectory(estimate, {}));
  EXPECT_FALSE(score_trajectory({}, truth));
}

TEST(Trajectory, FirstAfterTakesEachPoseOnce) {
  const Trajectory poses{{10, {1, 0, 0}}, {20, {2, 0, 0}}, {30, {3, 0, 0}}};
  const std::vector<std::int64_t> utimes{5, 6, 20, 29, 31};
  const Trajectory chosen = first_after(poses, utimes);
  ASSERT_EQ(chosen.size(), 3U);
  EXPECT_EQ(chosen[0].utime, 10);  // of 5 and 6
  EXPECT_EQ(chosen[1].utime, 20);
  EXPECT_EQ(chosen[2].utime, 30);  // of 29; there is none for 31
  EXPECT_TRUE(first_after({}, utimes).empty());
}

TEST(Trajectory, HeadingIsInterpolatedTheShortWayRound) {
  const Trajectory truth{{0, {0, 0, 3.0}}, {100'000, {2, 4, -3.0}}};
  const Pose2 half = pose_at(truth, 50'000).value();
  EXPECT_DOUBLE_EQ(half.x_m, 1.0);
  EXPECT_DOUBLE_EQ(half.y_m, 2.0);
  EXPECT_NEAR(std::abs(half.heading_rad), std::numbers::pi, 1e-12);
}

}  // namespace
}  // namespace roomwise
