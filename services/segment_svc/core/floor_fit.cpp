#include "services/segment_svc/core/floor_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace roomwise::segment {
namespace {

constexpr double kBin_m = 0.02;
constexpr int kBandBins = 3;      // 6 cm each side of a plane
constexpr int kBelowBins = 5;     // 10 cm below it
constexpr int kGridAcross = 107;  // points across an image: every 6th pixel of 640
constexpr double kDegree_rad = std::numbers::pi / 180.0;

/// Neighbouring grid points share much of their error (it is correlated over about 9 pixels): this
/// many count as one against the prior.
constexpr double kCorrelated = 50.0;
constexpr double kPriorTilt_rad = 3.0 * kDegree_rad;  // how well a mounting is known

double sigma_height_m(const Eigen::Vector3f& p_m, float quantum_m, const FloorPlane& plane) {
  // The error lies along the ray; only its part along the normal changes the height.
  return quantum_m * std::abs(plane.normal.dot(p_m.cast<double>())) / p_m.z();
}

/// Two unit vectors that with `normal` make a right-handed set: axes to tilt it about.
std::array<Eigen::Vector3d, 2> tangents(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d first = normal.unitOrthogonal();
  return {first, normal.cross(first)};
}

}  // namespace

FloorEstimate FloorFit::fit(const RgbdFrame& frame, const CameraView& view) {
  const FloorPlane mounted = mounted_floor(frame.T_robot_camera);
  sample(frame, view);

  FloorPlane start = search(mounted);
  if (last_.trusted) {
    const FloorPlane same_height{.normal = mounted.normal, .height_m = last_.plane.height_m};
    for (const FloorPlane& candidate : {same_height, last_.plane}) {
      if (is_allowed(candidate, mounted) && votes(candidate) >= votes(start)) start = candidate;
    }
  }
  const FloorPlane refined = refine(start, mounted);
  const int inliers = count_inliers(refined);
  if (inliers >= params_.floor_inliers_min && is_allowed(refined, mounted)) {
    last_ = {.plane = refined, .inliers = inliers, .trusted = true};
  } else {
    // A plane that was good a moment ago, tipped as the mounting says, else the mounting itself.
    const double height_m = last_.inliers > 0 ? last_.plane.height_m : mounted.height_m;
    last_.trusted = false;
    return {.plane = {.normal = mounted.normal, .height_m = height_m}, .inliers = inliers};
  }
  return last_;
}

void FloorFit::sample(const RgbdFrame& frame, const CameraView& view) {
  points_.clear();
  const int step_px = std::max(1, view.width_px() / kGridAcross);
  const auto unit_m = static_cast<float>(view.unit_m());
  const auto range_max_m = static_cast<float>(params_.range_max_m);
  for (int v = step_px / 2; v < view.height_px(); v += step_px) {
    for (int u = step_px / 2; u < view.width_px(); u += step_px) {
      const float z_m = unit_m * static_cast<float>(frame.depth.at(u, v));
      if (!(z_m > 0.0F) || z_m > range_max_m) continue;
      const float x = view.ray_x()[static_cast<std::size_t>(u)];
      const float y = view.ray_y()[static_cast<std::size_t>(v)];
      points_.push_back({Eigen::Vector3f(z_m * x, z_m * y, z_m), z_m * z_m * view.quantum_per_m()});
    }
  }
}

FloorPlane FloorFit::search(const FloorPlane& mounted) {
  const auto axes = tangents(mounted.normal);
  FloorPlane best = mounted;
  int best_votes = votes(mounted);
  for (int i = -2; i <= 2; ++i) {
    for (int j = -2; j <= 2; ++j) {
      const Eigen::Vector3d normal =
          (mounted.normal + 3.0 * kDegree_rad * (i * axes[0] + j * axes[1])).normalized();
      int plane_votes = 0;
      const FloorPlane plane = best_height(normal, plane_votes);
      if (plane_votes > best_votes) {
        best_votes = plane_votes;
        best = plane;
      }
    }
  }
  return best;
}

/// The height at which a plane with this normal gets most votes, by one histogram of the points'
/// distances below the camera.
FloorPlane FloorFit::best_height(const Eigen::Vector3d& normal, int& best_votes) {
  below_.fill(0);
  const Eigen::Vector3f n = normal.cast<float>();
  for (const Point& point : points_) {
    const auto bin = static_cast<int>(-n.dot(point.p_camera_m) * static_cast<float>(1.0 / kBin_m));
    if (bin >= 0) ++below_[static_cast<std::size_t>(std::min(bin, kHeightBins - 1))];
  }
  for (std::size_t i = 1; i < below_.size(); ++i) below_[i] += below_[i - 1];

  const auto up_to = [&](int bin) {
    return bin < 0 ? 0
                   : below_[std::min<std::size_t>(static_cast<std::size_t>(bin), kHeightBins - 1)];
  };
  const int first = static_cast<int>(params_.camera_height_min_m / kBin_m);
  const int last =
      std::min(kHeightBins - 1, static_cast<int>(params_.camera_height_max_m / kBin_m));
  FloorPlane best{.normal = normal, .height_m = (first + 0.5) * kBin_m};
  best_votes = 0;
  for (int bin = first; bin <= last; ++bin) {
    const int on = up_to(bin + kBandBins) - up_to(bin - kBandBins - 1);
    const int below = up_to(kHeightBins - 1) - up_to(bin + kBelowBins);
    if (on - 2 * below > best_votes) {
      best_votes = on - 2 * below;
      best.height_m = (bin + 0.5) * kBin_m;
    }
  }
  return best;
}

int FloorFit::votes(const FloorPlane& plane) const {
  const Eigen::Vector3f n = plane.normal.cast<float>();
  const auto h = static_cast<float>(plane.height_m);
  int votes = 0;
  for (const Point& point : points_) {
    const float height_m = n.dot(point.p_camera_m) + h;
    votes += std::abs(height_m) <= 0.06F ? 1 : 0;
    votes -= height_m < -0.10F ? 2 : 0;
  }
  return votes;
}

FloorPlane FloorFit::refine(const FloorPlane& start, const FloorPlane& mounted) const {
  FloorPlane plane = start;
  for (const double band_m : {0.10, 0.05, 0.03}) plane = refine_once(plane, mounted, band_m);
  return plane;
}

/// One Gauss-Newton step in (tilt about two axes, height), points weighted by their height's
/// variance, tilt held to the mounting by its prior.
FloorPlane FloorFit::refine_once(const FloorPlane& start, const FloorPlane& mounted,
                                 double band_m) const {
  const auto axes = tangents(start.normal);
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (const Point& point : points_) {
    const Eigen::Vector3d p_m = point.p_camera_m.cast<double>();
    const double height_m = start.normal.dot(p_m) + start.height_m;
    const double sigma_m = sigma_height_m(point.p_camera_m, point.quantum_m, start);
    if (std::abs(height_m) > band_m + 2.0 * sigma_m) continue;
    const double weight = 1.0 / (kCorrelated * (1e-4 + sigma_m * sigma_m));
    const Eigen::Vector3d jacobian(axes[0].dot(p_m), axes[1].dot(p_m), 1.0);
    information += weight * jacobian * jacobian.transpose();
    gradient -= weight * height_m * jacobian;
  }
  const double prior = 1.0 / (kPriorTilt_rad * kPriorTilt_rad);
  for (int i = 0; i < 2; ++i) {
    information(i, i) += prior;
    gradient[i] += prior * axes[static_cast<std::size_t>(i)].dot(mounted.normal);
  }
  information(2, 2) += 1.0;  // a metre: keeps the height where no point says anything
  const Eigen::Vector3d step = information.ldlt().solve(gradient);
  const Eigen::Vector3d normal = start.normal + step[0] * axes[0] + step[1] * axes[1];
  const double length = normal.norm();
  return {.normal = normal / length, .height_m = (start.height_m + step[2]) / length};
}

int FloorFit::count_inliers(const FloorPlane& plane) const {
  return static_cast<int>(std::count_if(points_.begin(), points_.end(), [&](const Point& point) {
    const double height_m = plane.normal.dot(point.p_camera_m.cast<double>()) + plane.height_m;
    const double sigma_m = sigma_height_m(point.p_camera_m, point.quantum_m, plane);
    return std::abs(height_m) <= params_.floor_tolerance_m + sigma_m;
  }));
}

bool FloorFit::is_allowed(const FloorPlane& plane, const FloorPlane& mounted) const {
  return plane.normal.dot(mounted.normal) >= std::cos(params_.tilt_max_rad) &&
         plane.height_m >= params_.camera_height_min_m &&
         plane.height_m <= params_.camera_height_max_m;
}

}  // namespace roomwise::segment
