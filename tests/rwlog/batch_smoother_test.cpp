#include "logs/tools/batch_smoother.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace roomwise {
namespace {

/// A circle among four landmarks; every node sees all of them. `off`: how wrong the first guess is.
SmoothProblem circle(double off) {
  SmoothProblem problem;
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> uniform(-off, off);
  const std::vector<Eigen::Vector2d> landmarks{{2.0, 0.5}, {-1.0, 3.0}, {0.0, 5.0}, {-2.0, 1.0}};
  constexpr int kNodes = 60;
  constexpr double kTurn_rad = 2.0 * std::numbers::pi / kNodes;
  Pose2 pose;
  for (int i = 0; i < kNodes; ++i) {
    problem.utimes.push_back(1'000'000 + 100'000 * i);
    problem.poses.push_back(pose);
    for (std::size_t l = 0; l < landmarks.size(); ++l) {
      problem.sightings.push_back({problem.poses.size() - 1, l,
                                   transform(inverse(pose), landmarks[l]),
                                   1e-4 * Eigen::Matrix2d::Identity()});
    }
    ekf::MotionIncrement motion;
    motion.append(ekf::arc_step(2.0 * kTurn_rad, kTurn_rad, 1e-4 * Eigen::Matrix2d::Identity()));
    pose = ekf::moved(pose, motion);
    if (i + 1 < kNodes) problem.motions.push_back(motion);
  }
  for (std::size_t i = 1; i < problem.poses.size(); ++i) {
    Pose2& guess = problem.poses[i];
    guess = {guess.x_m + uniform(engine), guess.y_m + uniform(engine),
             guess.heading_rad + uniform(engine)};
  }
  for (const Eigen::Vector2d& p : landmarks) {
    problem.landmarks_m.emplace_back(p.x() + uniform(engine), p.y() + uniform(engine));
  }
  return problem;
}

double farthest_m(const SmoothProblem& a, const SmoothProblem& b) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    farthest = std::max(farthest, (a.poses[i].position_m() - b.poses[i].position_m()).norm());
  }
  for (std::size_t l = 0; l < a.landmarks_m.size(); ++l) {
    farthest = std::max(farthest, (a.landmarks_m[l] - b.landmarks_m[l]).norm());
  }
  return farthest;
}

TEST(BatchSmoother, WithoutNoiseThePathAndTheMapComeBack) {
  SmoothProblem problem = circle(0.1);
  const SmoothReport report = smooth(problem);
  EXPECT_TRUE(report.converged);
  EXPECT_LT(report.cost_after, 1e-6 * report.cost_before);
  EXPECT_LT(farthest_m(problem, circle(0.0)), 1e-4);
}

TEST(BatchSmoother, WheelsThatReportTooMuchAreFoundOut) {
  SmoothProblem problem = circle(0.05);
  ekf::OdometryCalibration doubtful;
  doubtful.value << 0.08, -0.05, 0.0;  // the motions are what these would make of the reports
  for (ekf::MotionIncrement& motion : problem.motions) {
    ekf::MotionIncrement wrong;
    wrong.append(ekf::arc_step(motion.translation_m.norm() / 1.08, motion.turn_rad / 0.95,
                               1e-4 * Eigen::Matrix2d::Identity()));
    motion = wrong;
  }
  smooth(problem);
  EXPECT_NEAR(problem.calibration.distance_ratio(), doubtful.distance_ratio(), 0.005);
  // On a circle turn and distance go together: only the sum of what makes turns shows.
  constexpr double kDistancePerTurn_m_per_rad = 2.0;
  EXPECT_NEAR(problem.calibration.turn_ratio() +
                  kDistancePerTurn_m_per_rad * problem.calibration.turn_per_distance_rad_per_m(),
              doubtful.turn_ratio(), 0.005);
}

TEST(BatchSmoother, DepthsGivenForRangesAreFoundOut) {
  SmoothProblem problem = circle(0.05);
  const ekf::RangeCalibration depths{{0.0, -0.08}};
  for (SmoothSighting& seen : problem.sightings) {
    seen.p_robot_m *= depths.ratio(std::atan2(seen.p_robot_m.y(), seen.p_robot_m.x()));
  }
  smooth(problem);
  EXPECT_LT((problem.ranges.value - depths.value).norm(), 0.005);
  EXPECT_LT(farthest_m(problem, circle(0.0)), 0.01);
}

TEST(BatchSmoother, OneMisreadLandmarkBendsNothing) {
  SmoothProblem problem = circle(0.02);
  problem.sightings[100].p_robot_m = {-3.0, -3.0};
  smooth(problem);
  EXPECT_LT(farthest_m(problem, circle(0.0)), 0.01);
}

}  // namespace
}  // namespace roomwise
