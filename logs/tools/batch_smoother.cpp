#include "logs/tools/batch_smoother.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

namespace roomwise {
namespace {

constexpr double kCauchySigmas = 2.0;
constexpr double kCalibrationSigma = 0.1;  // what to expect of the scales and the pull
constexpr double kStandstillSigma = 1e-3;  // odometry is never surer than this [m, rad]

using Heading = std::array<double, 3>;  // heading, x, y

template <int kSize>
Eigen::Matrix<double, kSize, kSize> whitener(
    const Eigen::Matrix<double, kSize, kSize>& covariance) {
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  return covariance.llt().matrixL().solve(Matrix::Identity());
}

template <class T>
Eigen::Matrix<T, 2, 1> into_robot(const T* pose, const Eigen::Matrix<T, 2, 1>& p_map) {
  const T c = cos(pose[0]), s = sin(pose[0]);
  const Eigen::Matrix<T, 2, 1> d(p_map.x() - pose[1], p_map.y() - pose[2]);
  return {c * d.x() + s * d.y(), c * d.y() - s * d.x()};
}

struct OdometryCost {
  ekf::MotionIncrement motion;
  Eigen::Vector4d calibration_then;  // the motion's
  Eigen::Matrix3d root;

  template <class T>
  bool operator()(const T* a, const T* b, const T* calibration, T* residual) const {
    Eigen::Matrix<T, 4, 1> change;
    for (int i = 0; i < 4; ++i) change(i) = calibration[i] - calibration_then(i);
    const Eigen::Matrix<T, 3, 1> shift = motion.per_calibration.cast<T>() * change;
    const Eigen::Matrix<T, 2, 1> moved = into_robot<T>(a, Eigen::Matrix<T, 2, 1>(b[1], b[2]));
    const T turn = b[0] - a[0] - motion.turn_rad - shift(0);
    Eigen::Matrix<T, 3, 1> error(atan2(sin(turn), cos(turn)),
                                 moved.x() - motion.translation_m.x() - shift(1),
                                 moved.y() - motion.translation_m.y() - shift(2));
    Eigen::Map<Eigen::Matrix<T, 3, 1>> whitened(residual);
    whitened = root.cast<T>() * error;
    return true;
  }
};

struct SightingCost {
  Eigen::Vector2d p_robot_m;
  Eigen::Vector2d shape;  // RangeCalibration's, where it was seen
  Eigen::Matrix2d root;

  template <class T>
  bool operator()(const T* pose, const T* landmark, const T* ranges, T* residual) const {
    const Eigen::Matrix<T, 2, 1> p(landmark[0], landmark[1]);
    const T ratio = 1.0 + shape.x() * ranges[0] + shape.y() * ranges[1];
    Eigen::Map<Eigen::Matrix<T, 2, 1>> whitened(residual);
    whitened = root.cast<T>() * (ratio * into_robot<T>(pose, p) - p_robot_m.cast<T>());
    return true;
  }
};

template <int kSize>
struct CalibrationCost {
  template <class T>
  bool operator()(const T* calibration, T* residual) const {
    for (int i = 0; i < kSize; ++i) residual[i] = calibration[i] / kCalibrationSigma;
    return true;
  }
};

template <int kSize>
void expect_small(double* calibration, ceres::Problem& problem) {
  using Cost = CalibrationCost<kSize>;
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Cost, kSize, kSize>(new Cost), nullptr,
                           calibration);
}

void add_odometry(SmoothProblem& from, Eigen::Vector4d& calibration, std::vector<Heading>& poses,
                  ceres::Problem& problem) {
  for (std::size_t i = 0; i < from.motions.size(); ++i) {
    const Eigen::Matrix3d floor = kStandstillSigma * kStandstillSigma * Eigen::Matrix3d::Identity();
    auto* cost = new ceres::AutoDiffCostFunction<OdometryCost, 3, 3, 3, 4>(new OdometryCost{
        from.motions[i], calibration, whitener<3>(from.motions[i].covariance + floor)});
    problem.AddResidualBlock(cost, nullptr, poses[i].data(), poses[i + 1].data(),
                             calibration.data());
  }
}

void add_sightings(SmoothProblem& from, std::vector<Heading>& poses, ceres::Problem& problem) {
  for (const SmoothSighting& seen : from.sightings) {
    auto* cost = new ceres::AutoDiffCostFunction<SightingCost, 2, 3, 2, 2>(new SightingCost{
        seen.p_robot_m,
        ekf::RangeCalibration::shape(std::atan2(seen.p_robot_m.y(), seen.p_robot_m.x())),
        whitener<2>(seen.covariance_m2)});
    problem.AddResidualBlock(cost, new ceres::CauchyLoss(kCauchySigmas), poses[seen.node].data(),
                             from.landmarks_m[seen.landmark].data(), from.ranges.value.data());
  }
}

}  // namespace

SmoothReport smooth(SmoothProblem& from) {
  std::vector<Heading> poses;
  for (const Pose2& pose : from.poses) poses.push_back({pose.heading_rad, pose.x_m, pose.y_m});
  ceres::Problem problem;
  Eigen::Vector4d calibration;
  calibration << from.calibration.value, from.calibration.turn_loss_m_per_rad;
  add_odometry(from, calibration, poses, problem);
  add_sightings(from, poses, problem);
  expect_small<4>(calibration.data(), problem);
  expect_small<2>(from.ranges.value.data(), problem);
  problem.SetParameterBlockConstant(poses.front().data());

  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 100;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  from.calibration = {calibration.head<3>(), calibration(3)};
  for (std::size_t i = 0; i < poses.size(); ++i) {
    from.poses[i] = {poses[i][1], poses[i][2], wrap_angle(poses[i][0])};
  }
  return {summary.initial_cost, summary.final_cost, static_cast<int>(summary.iterations.size()),
          summary.termination_type == ceres::CONVERGENCE};
}

}  // namespace roomwise
