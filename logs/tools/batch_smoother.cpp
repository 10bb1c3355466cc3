#include "logs/tools/batch_smoother.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <array>

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
  Eigen::Vector3d calibration_then;  // the motion's
  Eigen::Matrix3d root;

  template <class T>
  bool operator()(const T* a, const T* b, const T* calibration, T* residual) const {
    Eigen::Matrix<T, 3, 1> change;
    for (int i = 0; i < 3; ++i) change(i) = calibration[i] - calibration_then(i);
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
  Eigen::Matrix2d root;

  template <class T>
  bool operator()(const T* pose, const T* landmark, T* residual) const {
    const Eigen::Matrix<T, 2, 1> p(landmark[0], landmark[1]);
    Eigen::Map<Eigen::Matrix<T, 2, 1>> whitened(residual);
    whitened = root.cast<T>() * (into_robot<T>(pose, p) - p_robot_m.cast<T>());
    return true;
  }
};

struct CalibrationCost {
  template <class T>
  bool operator()(const T* calibration, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = calibration[i] / kCalibrationSigma;
    return true;
  }
};

void add_odometry(SmoothProblem& from, std::vector<Heading>& poses, ceres::Problem& problem) {
  for (std::size_t i = 0; i < from.motions.size(); ++i) {
    const Eigen::Matrix3d floor = kStandstillSigma * kStandstillSigma * Eigen::Matrix3d::Identity();
    auto* cost = new ceres::AutoDiffCostFunction<OdometryCost, 3, 3, 3, 3>(new OdometryCost{
        from.motions[i], from.calibration.value, whitener<3>(from.motions[i].covariance + floor)});
    problem.AddResidualBlock(cost, nullptr, poses[i].data(), poses[i + 1].data(),
                             from.calibration.value.data());
  }
}

void add_sightings(SmoothProblem& from, std::vector<Heading>& poses, ceres::Problem& problem) {
  for (const SmoothSighting& seen : from.sightings) {
    auto* cost = new ceres::AutoDiffCostFunction<SightingCost, 2, 3, 2>(
        new SightingCost{seen.p_robot_m, whitener<2>(seen.covariance_m2)});
    problem.AddResidualBlock(cost, new ceres::CauchyLoss(kCauchySigmas), poses[seen.node].data(),
                             from.landmarks_m[seen.landmark].data());
  }
}

}  // namespace

SmoothReport smooth(SmoothProblem& from) {
  std::vector<Heading> poses;
  for (const Pose2& pose : from.poses) poses.push_back({pose.heading_rad, pose.x_m, pose.y_m});
  ceres::Problem problem;
  add_odometry(from, poses, problem);
  add_sightings(from, poses, problem);
  problem.AddResidualBlock(
      new ceres::AutoDiffCostFunction<CalibrationCost, 3, 3>(new CalibrationCost), nullptr,
      from.calibration.value.data());
  problem.SetParameterBlockConstant(poses.front().data());

  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 100;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    from.poses[i] = {poses[i][1], poses[i][2], wrap_angle(poses[i][0])};
  }
  return {summary.initial_cost, summary.final_cost, static_cast<int>(summary.iterations.size()),
          summary.termination_type == ceres::CONVERGENCE};
}

}  // namespace roomwise
