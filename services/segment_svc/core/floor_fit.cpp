#include "services/segment_svc/core/floor_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "common/multiversion.h"

namespace roomwise::segment {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;
constexpr std::array<double, 4> kWideBands_m = {0.10, 0.10, 0.10, 0.08};
constexpr std::array<double, 5> kBands_m = {0.05, 0.03, 0.02, 0.015, 0.012};

/// A plane that the first narrow band moves less than this needs no wide ones.
constexpr double kNearTilt_rad = 0.3 * kDegree_rad;
constexpr double kNearHeight_m = 0.005;

/// Neighbouring grid points share much of their error (it is correlated over about 9 pixels, and
/// lenses bend): this many count as one against the prior.
constexpr double kCorrelated = 50.0;
constexpr double kPriorTilt_rad = 3.0 * kDegree_rad;  // tilt changes less between frames

/// A plane this near to the mounting's is the floor the mounting was measured on.
constexpr double kMountedTilt_rad = 5.0 * kDegree_rad;
constexpr double kMountedHeight_m = 0.05;

bool are_near(const FloorPlane& a, const FloorPlane& b) {
  return a.normal.dot(b.normal) >= std::cos(kNearTilt_rad) &&
         std::abs(a.height_m - b.height_m) <= kNearHeight_m;
}

bool is_as_mounted(const FloorPlane& plane, const FloorPlane& mounted) {
  return plane.normal.dot(mounted.normal) >= std::cos(kMountedTilt_rad) &&
         std::abs(plane.height_m - mounted.height_m) <= kMountedHeight_m;
}

constexpr std::size_t kLanes = 16;

/// Sums of the normal equations over the points near a plane, in lanes, so that many points are
/// added at a time, always in the same order.
struct StepSums {
  using Lanes = std::array<float, kLanes>;
  Lanes aa{}, ab{}, bb{}, a{}, b{}, one{}, ha{}, hb{}, h{};

  Eigen::Matrix3d information() const {
    Eigen::Matrix3d sum;
    sum << total(aa), total(ab), total(a), total(ab), total(bb), total(b), total(a), total(b),
        total(one);
    return sum;
  }
  Eigen::Vector3d gradient() const { return -Eigen::Vector3d(total(ha), total(hb), total(h)); }

  static double total(const Lanes& lanes) {
    double sum = 0.0;
    for (const float lane : lanes) sum += static_cast<double>(lane);
    return sum;
  }
};

/// The plane a step starts from, two directions to tilt it about, and which points count.
struct StepRule {
  FloatPlane plane;
  Eigen::Vector3f first;
  Eigen::Vector3f second;
  float band_m;
};

inline void add_point(const FloorPoint& point, const StepRule& rule, std::size_t lane,
                      StepSums& sums) {
  const auto [height_m, sigma_m] = rule.plane(point);
  const float variance = 1e-4F + sigma_m * sigma_m;
  float weight = static_cast<float>(1.0 / kCorrelated) / variance;
  weight = std::abs(height_m) <= rule.band_m + sigma_m ? weight : 0.0F;
  const float a = rule.first.dot(point.p_camera_m);
  const float b = rule.second.dot(point.p_camera_m);
  const float wa = weight * a;
  const float wb = weight * b;
  const float wh = weight * height_m;
  sums.aa[lane] += wa * a;
  sums.ab[lane] += wa * b;
  sums.bb[lane] += wb * b;
  sums.a[lane] += wa;
  sums.b[lane] += wb;
  sums.one[lane] += weight;
  sums.ha[lane] += wh * a;
  sums.hb[lane] += wh * b;
  sums.h[lane] += wh;
}

ROOMWISE_MULTIVERSION
void add_points(const FloorPoint* points, std::size_t count, const StepRule& rule,
                StepSums& __restrict sums) {
  StepSums local;
  const std::size_t whole = count - count % kLanes;
  for (std::size_t i = 0; i < whole; i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      add_point(points[i + lane], rule, lane, local);
    }
  }
  for (std::size_t i = whole; i < count; ++i) add_point(points[i], rule, i - whole, local);
  sums = local;
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
  if (!are_near(refine(from, kBands_m.front()), from)) {
    for (const double band_m : kWideBands_m) plane = refine(plane, band_m);
  }
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
  StepSums sums;
  add_points(points_.data(), points_.size(),
             {.plane = FloatPlane(start),
              .first = first.cast<float>(),
              .second = second.cast<float>(),
              .band_m = static_cast<float>(band_m)},
             sums);
  Eigen::Matrix3d information = sums.information();
  information(0, 0) += 1.0 / (kPriorTilt_rad * kPriorTilt_rad);
  information(1, 1) += 1.0 / (kPriorTilt_rad * kPriorTilt_rad);
  information(2, 2) += 1.0;  // a metre
  const Eigen::Vector3d step = information.ldlt().solve(sums.gradient());
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
