#include "services/segment_svc/core/floor_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace roomwise::segment {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;
constexpr std::array<double, 9> kBands_m = {0.10, 0.10, 0.10, 0.08, 0.05, 0.03, 0.02, 0.015, 0.012};

/// Neighbouring grid points share much of their error (it is correlated over about 9 pixels, and
/// lenses bend): this many count as one against the prior.
constexpr double kCorrelated = 50.0;
constexpr double kPriorTilt_rad = 3.0 * kDegree_rad;  // tilt changes less between frames

/// A plane this near to the mounting's is the floor the mounting was measured on.
constexpr double kMountedTilt_rad = 5.0 * kDegree_rad;
constexpr double kMountedHeight_m = 0.05;

bool is_as_mounted(const FloorPlane& plane, const FloorPlane& mounted) {
  return plane.normal.dot(mounted.normal) >= std::cos(kMountedTilt_rad) &&
         std::abs(plane.height_m - mounted.height_m) <= kMountedHeight_m;
}

int votes(const FloorPlane& plane, const std::vector<FloorPoint>& points) {
  const FloatPlane height_of(plane);
  int votes = 0;
  for (const FloorPoint& point : points) {
    const float height_m = height_of(point).height_m;
    votes += std::abs(height_m) <= 0.06F ? 1 : 0;
    votes -= height_m < -0.10F ? 2 : 0;
  }
  return votes;
}

}  // namespace

FloorFit::FloorFit(const SegmentParams& params)
    : params_(params),
      search_({.camera_height_min_m = params.camera_height_min_m,
               .camera_height_max_m = params.camera_height_max_m,
               .tilt_max_rad = params.tilt_max_rad}) {}

FloorEstimate FloorFit::fit(const RgbdFrame& frame, const CameraView& view) {
  const FloorPlane mounted = mounted_floor(frame.T_robot_camera);
  sample_points(frame, view, params_.range_max_m, points_);
  std::optional<FloorEstimate> found = track(mounted, frame.T_robot_camera);
  if (!found) found = start(mounted);
  const bool is_high = found && 10 * beneath_ > found->inliers;
  if (!found || (is_high && !is_as_mounted(found->plane, mounted))) {
    if (const auto lower = find(mounted)) found = lower;
  }
  if (!found) {
    const FloorPlane kept =
        last_ ? carried_floor(*last_, T_robot_last_, frame.T_robot_camera) : mounted;
    return {.plane = is_allowed(kept, mounted) ? kept : mounted};
  }
  last_ = found->plane;
  T_robot_last_ = frame.T_robot_camera;
  return *found;
}

std::optional<FloorEstimate> FloorFit::track(const FloorPlane& mounted,
                                             const Eigen::Isometry3d& T_robot_camera) {
  if (!last_) return std::nullopt;
  return settle(predict(mounted, T_robot_camera), mounted);
}

FloorPlane FloorFit::predict(const FloorPlane& mounted,
                             const Eigen::Isometry3d& T_robot_camera) const {
  const FloorPlane moved = carried_floor(*last_, T_robot_last_, T_robot_camera);
  FloorPlane best = moved;
  int best_votes = votes(moved, points_);
  for (const FloorPlane& other :
       {*last_, FloorPlane{.normal = mounted.normal, .height_m = moved.height_m}}) {
    const int other_votes = votes(other, points_);
    if (other_votes > best_votes) {
      best_votes = other_votes;
      best = other;
    }
  }
  return best;
}

/// With nothing to follow: the mounting's own plane, or what the search finds close to it. From
/// some degrees off, the refinement can settle askew on a part of the floor; the search does not,
/// and then has more points.
std::optional<FloorEstimate> FloorFit::start(const FloorPlane& mounted) {
  constexpr double kSameFloor_m = 0.30;
  const std::optional<FloorEstimate> near = settle(mounted, mounted);
  if (!near) return std::nullopt;
  const int beneath_near = beneath_;
  const std::optional<FloorEstimate> searched = find(mounted);
  if (searched && searched->inliers > near->inliers &&
      std::abs(searched->plane.height_m - near->plane.height_m) <= kSameFloor_m) {
    return searched;
  }
  beneath_ = beneath_near;
  return near;
}

/// The lowest horizontal surface.
std::optional<FloorEstimate> FloorFit::find(const FloorPlane& mounted) {
  for (const FloorPlane& candidate : search_.search(points_, mounted)) {
    if (const auto found = settle(candidate, mounted)) return found;
  }
  return std::nullopt;
}

std::optional<FloorEstimate> FloorFit::settle(const FloorPlane& from, const FloorPlane& mounted) {
  FloorPlane plane = from;
  for (const double band_m : kBands_m) plane = refine(plane, band_m);
  const PlaneSupport support =
      support_of(plane, points_, params_.floor_tolerance_m, params_.drop_off_depth_m);
  beneath_ = support.beneath;
  if (support.on < params_.floor_inliers_min || !support.is_flat() || !is_allowed(plane, mounted)) {
    return std::nullopt;
  }
  return FloorEstimate{.plane = plane, .inliers = support.on, .trusted = true};
}

/// One Gauss-Newton step in (tilt about two axes, height), points weighted by their height's
/// variance. The prior keeps what no point says anything about.
FloorPlane FloorFit::refine(const FloorPlane& start, double band_m) const {
  const Eigen::Vector3d first = start.normal.unitOrthogonal();
  const Eigen::Vector3d second = start.normal.cross(first);
  const Eigen::Vector3f first_f = first.cast<float>();
  const Eigen::Vector3f second_f = second.cast<float>();
  const FloatPlane height_of(start);
  const auto band = static_cast<float>(band_m);
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  for (const FloorPoint& point : points_) {
    const auto [height_m, sigma_m] = height_of(point);
    if (!(std::abs(height_m) <= band + 1.0F * sigma_m)) continue;
    const double weight = 1.0 / (kCorrelated * (1e-4 + static_cast<double>(sigma_m * sigma_m)));
    const Eigen::Vector3d jacobian(first_f.dot(point.p_camera_m), second_f.dot(point.p_camera_m),
                                   1.0);
    information.noalias() += (weight * jacobian) * jacobian.transpose();
    gradient -= (weight * static_cast<double>(height_m)) * jacobian;
  }
  information(0, 0) += 1.0 / (kPriorTilt_rad * kPriorTilt_rad);
  information(1, 1) += 1.0 / (kPriorTilt_rad * kPriorTilt_rad);
  information(2, 2) += 1.0;  // a metre
  const Eigen::Vector3d step = information.ldlt().solve(gradient);
  const Eigen::Vector3d normal = start.normal + step[0] * first + step[1] * second;
  const double length = normal.norm();
  return {.normal = normal / length, .height_m = (start.height_m + step[2]) / length};
}

bool FloorFit::is_allowed(const FloorPlane& plane, const FloorPlane& mounted) const {
  return plane.normal.dot(mounted.normal) >= std::cos(params_.tilt_max_rad) &&
         plane.height_m >= params_.camera_height_min_m &&
         plane.height_m <= params_.camera_height_max_m;
}

}  // namespace roomwise::segment
