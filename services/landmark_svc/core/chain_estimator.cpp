#include "services/landmark_svc/core/chain_estimator.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "services/landmark_svc/core/line_fit.h"
#include "services/landmark_svc/core/surface_color.h"

namespace roomwise::landmark {
namespace {

/// Column of the edge line itself: the outer border of the near pixel.
double edge_column_px(const EdgePixel& edge) { return edge.u_px - 0.5 * edge.inward_px(); }

/// How far, at 640 px, matching by windows misplaces a border row by row: readings so near to it
/// may be of that many pixels beside their own.
constexpr double kMisplaced_px = 2.0;

/// Where the edge line is, in pixels from the near pixel inwards.
constexpr double kBorder_px = -0.5;

/// First pixel of the near surface to use: the near pixel itself, often a mixture of both
/// surfaces, serves only where there is no other.
int first_inside_px(const EdgePixel& edge) { return edge.near_run_px > 1 ? 1 : 0; }

double mean_step_m(const DisparityTable& table, std::span<const EdgePixel> chain) {
  double sum_m = 0.0;
  for (const EdgePixel& pixel : chain) {
    sum_m += table.depth_m(pixel.far_steps) - table.depth_m(pixel.near_steps);
  }
  return sum_m / static_cast<double>(chain.size());
}

double mean_depth_m(const DisparityTable& table, std::span<const EdgePixel> chain) {
  double sum_m = 0.0;
  for (const EdgePixel& pixel : chain) sum_m += table.depth_m(pixel.near_steps);
  return sum_m / static_cast<double>(chain.size());
}

ChromaSignature near_color(const ColorAtDepth& color_at_depth, const ColorWeightParams& params,
                           std::span<const EdgePixel> chain) {
  SurfaceColor color(params.dark_luma_levels, params.noise_levels);
  if (!color_at_depth.available()) return color.signature();
  constexpr int kInside_px = 3;  // registration and the lens blur the border by a pixel or two
  for (const EdgePixel& pixel : chain) {
    for (int k = kInside_px; k < pixel.near_run_px; ++k) {
      color.add(color_at_depth.rgb(pixel.u_px + k * pixel.inward_px(), pixel.v_px));
    }
  }
  return color.signature();
}

/// Whether readings misplaced by that much explain how the first pixel differs from the line.
bool goes_on_to_border(double first_parts, const LineFit& line, double misplaced_px) {
  constexpr double kNoise_parts = 0.5 * DisparityTable::kPartsPerQuantum;
  const double too_flat_parts = std::copysign(1.0, line.slope()) * (first_parts - line.at(1.0));
  return too_flat_parts >= -kNoise_parts &&
         too_flat_parts <= kNoise_parts + misplaced_px * std::abs(line.slope());
}

bool all_finite(const Landmark& landmark) {
  return std::isfinite(landmark.range_m) && std::isfinite(landmark.bearing_rad) &&
         landmark.covariance.allFinite() && std::isfinite(landmark.height_low_m) &&
         std::isfinite(landmark.height_high_m);
}

}  // namespace

/// Lateral and along-ray position of the edge against height.
struct ChainEstimator::Lines {
  LineFit lateral_m;
  LineFit along_m;
  double height_low_m = 0.0;
  double height_high_m = 0.0;
  double lateral_rms_m = 0.0;  ///< of all points about the lateral line, kept or not

  double height_span_m() const { return height_high_m - height_low_m; }
};

void ChainEstimator::reserve(int height_px) {
  near_rows_.reserve(static_cast<std::size_t>(height_px));
  points_.reserve(static_cast<std::size_t>(height_px));
}

std::optional<RejectReason> ChainEstimator::estimate(const Scene& scene,
                                                     std::span<const EdgePixel> chain,
                                                     const ChainEstimateParams& params,
                                                     Landmark& landmark) {
  const double rows = static_cast<double>(chain.size());
  const double rows_min = std::max(3.0, params.rows_min_px * scene.depth.height_px / 480.0);
  if (rows < rows_min) return RejectReason::kChainTooFewRows;
  const std::optional<Middle> middle = find_middle(scene, chain);
  if (!middle) return RejectReason::kLandmarkUnfit;
  const std::optional<double> slope_quanta_px = place_points(scene, chain, *middle);
  if (!slope_quanta_px) return RejectReason::kLandmarkUnfit;

  const Lines all = fit_lines();
  const double pixel_m = all.along_m.mean_y() / scene.camera.fx_px;
  const double column_rms_px = all.lateral_rms_m / pixel_m;
  if (all.height_span_m() < params.height_span_min_m) return RejectReason::kChainTooLow;
  if (!(column_rms_px < params.column_rms_max_px * scene.depth.width_px / 640.0)) {
    return RejectReason::kChainTooRagged;
  }
  trim(all, pixel_m);
  const Lines lines = fit_lines();
  const double quantum_m = scene.table.quantum_m(lines.along_m.mean_y());
  const double depth_sigma_m =
      params.depth_noise_quanta * quantum_m / std::sqrt(std::min(rows, 9.0));
  if (!is_vertical(lines, depth_sigma_m, params.lean_max_rad)) return RejectReason::kChainLeaning;

  const double slant_sigma_m = *slope_quanta_px * quantum_m * params.lateral_noise_px;
  const double along_variance_m2 = depth_sigma_m * depth_sigma_m + slant_sigma_m * slant_sigma_m +
                                   params.depth_bias_m * params.depth_bias_m;
  describe_position(scene, *middle, lines, along_variance_m2, params, landmark);
  describe_look(scene, chain, landmark);
  landmark.u_px = middle->u_px;
  const double raggedness = column_rms_px / 2.0;
  landmark.score_ratio = rows / (rows + rows_min) *
                         (landmark.step_m / (landmark.step_m + quantum_m)) /
                         (1.0 + raggedness * raggedness);
  if (const auto reason = look_for_round(scene, chain, *middle, params, landmark)) return reason;
  constexpr double kRangeMin_m = 1e-3;
  if (!all_finite(landmark) || landmark.range_m < kRangeMin_m) return RejectReason::kLandmarkUnfit;
  return std::nullopt;
}

std::optional<RejectReason> ChainEstimator::look_for_round(const Scene& scene,
                                                           std::span<const EdgePixel> chain,
                                                           const Middle& middle,
                                                           const ChainEstimateParams& params,
                                                           Landmark& landmark) {
  const Eigen::Vector3d ray_camera((middle.u_px - scene.camera.cx_px) / scene.camera.fx_px,
                                   (middle.v_px - scene.camera.cy_px) / scene.camera.fy_px, 1.0);
  const Eigen::Vector2d ahead = scene.T_robot_camera.linear().col(2).head<2>().normalized();
  const Eigen::Vector2d left(-ahead.y(), ahead.x());
  const double along_ratio = ahead.dot((scene.T_robot_camera.linear() * ray_camera).head<2>());
  if (!(along_ratio > 0.1)) return std::nullopt;
  profile_.gather(scene.depth, scene.camera, scene.table, chain, along_ratio, params.round.arc_m);
  TangentCircle circle;
  const ProfileShape shape = profile_.shape(scene.table, params.round, circle);
  if (shape == ProfileShape::kLimb) return RejectReason::kChainOnLimb;
  if (shape == ProfileShape::kFlat) return std::nullopt;
  landmark.kind = LandmarkKind::kPole;
  landmark.u_px = scene.camera.cx_px -
                  scene.camera.fx_px * along_ratio * circle.center_m.y() / circle.center_m.x();
  const Eigen::Vector2d p_robot_m = scene.T_robot_camera.translation().head<2>() +
                                    circle.center_m.x() * ahead + circle.center_m.y() * left;
  const double radius_sigma_m = 0.15 * circle.radius_m;  // a short arc tells the radius badly
  const double quantum_m = scene.table.quantum_m(circle.center_m.x());
  const double sigma_m = std::hypot(radius_sigma_m + circle.rms_m, 0.3 * quantum_m);
  const double variance_m2 = sigma_m * sigma_m + params.lateral_bias_m * params.lateral_bias_m;
  set_position(landmark, p_robot_m, variance_m2 * Eigen::Matrix2d::Identity());
  return std::nullopt;
}

bool ChainEstimator::is_vertical(const Lines& lines, double depth_sigma_m, double lean_max_rad) {
  // Depth noise alone tilts a short edge towards or away from the camera.
  const double along_noise = depth_sigma_m / std::sqrt(lines.along_m.variance_x() + 1e-12);
  const double lean_max = std::tan(lean_max_rad);
  return std::abs(lines.lateral_m.slope()) < lean_max &&
         std::abs(lines.along_m.slope()) < lean_max + 3.0 * along_noise;
}

void ChainEstimator::describe_position(const Scene& scene, const Middle& middle, const Lines& lines,
                                       double along_variance_m2, const ChainEstimateParams& params,
                                       Landmark& landmark) {
  const Eigen::Vector2d left(-middle.forward.y(), middle.forward.x());
  const double z_m = lines.along_m.mean_y();
  const Eigen::Vector2d p_robot_m = scene.T_robot_camera.translation().head<2>() +
                                    z_m * middle.forward + lines.lateral_m.mean_y() * left;
  const double lateral_noise_m = params.lateral_noise_px * z_m / scene.camera.fx_px;
  const double lateral_variance_m2 =
      lateral_noise_m * lateral_noise_m + params.lateral_bias_m * params.lateral_bias_m;
  set_position(landmark, p_robot_m,
               along_variance_m2 * middle.forward * middle.forward.transpose() +
                   lateral_variance_m2 * left * left.transpose());
  landmark.height_low_m = lines.height_low_m;
  landmark.height_high_m = lines.height_high_m;
}

void ChainEstimator::describe_look(const Scene& scene, std::span<const EdgePixel> chain,
                                   Landmark& landmark) {
  landmark.kind =
      chain.front().side == EdgeSide::kLeft ? LandmarkKind::kEdgeLeft : LandmarkKind::kEdgeRight;
  landmark.step_m = mean_step_m(scene.table, chain);
  landmark.chroma = near_color(scene.color, scene.color_params, chain);
  landmark.rows = static_cast<int>(chain.size());
  const EdgePixel& low = chain.front();
  const EdgePixel& high = chain.back();
  landmark.column_slope = low.v_px == high.v_px
                              ? 0.0
                              : static_cast<double>(low.u_px - high.u_px) / (low.v_px - high.v_px);
  landmark.depth_m = mean_depth_m(scene.table, chain);
  landmark.v_top_px = chain.back().v_px;
  landmark.v_bottom_px = chain.front().v_px;
}

std::optional<ChainEstimator::Middle> ChainEstimator::find_middle(
    const Scene& scene, std::span<const EdgePixel> chain) {
  Middle middle{0.0, 0.0, {1.0, 0.0}};
  for (const EdgePixel& pixel : chain) {
    middle.u_px += edge_column_px(pixel);
    middle.v_px += pixel.v_px;
  }
  middle.u_px /= static_cast<double>(chain.size());
  middle.v_px /= static_cast<double>(chain.size());
  const Eigen::Vector3d ray_camera((middle.u_px - scene.camera.cx_px) / scene.camera.fx_px,
                                   (middle.v_px - scene.camera.cy_px) / scene.camera.fy_px, 1.0);
  const Eigen::Vector2d horizontal = (scene.T_robot_camera.linear() * ray_camera).head<2>();
  const double length = horizontal.norm();
  constexpr double kSteepest = 0.1;  // a camera that looks straight down sees no vertical edges
  if (!std::isfinite(length) || length < kSteepest) return std::nullopt;
  middle.forward = horizontal / length;
  return middle;
}

std::optional<double> ChainEstimator::place_points(const Scene& scene,
                                                   std::span<const EdgePixel> chain,
                                                   const Middle& middle) {
  gather_near_rows(scene, chain);
  const Inside inside = inside_of(chain, kMisplaced_px * scene.depth.width_px / 640.0);
  SurfacePlane rough = near_plane(chain, middle, inside, nullptr);
  if (!rough.solve()) return std::nullopt;
  SurfacePlane plane = near_plane(chain, middle, inside, &rough);
  if (!plane.solve()) plane = rough;

  const Eigen::Matrix3d rotation = scene.T_robot_camera.linear();
  const double camera_height_m = scene.T_robot_camera.translation().z();
  points_.clear();
  for (const EdgePixel& pixel : chain) {
    const double u = edge_column_px(pixel);
    const double quanta = plane.at(kBorder_px, pixel.v_px) / DisparityTable::kPartsPerQuantum;
    if (!(quanta > 0.5)) return std::nullopt;
    const Eigen::Vector3d ray_camera((u - scene.camera.cx_px) / scene.camera.fx_px,
                                     (pixel.v_px - scene.camera.cy_px) / scene.camera.fy_px, 1.0);
    const Eigen::Vector3d p_m = rotation * ray_camera * scene.table.depth_from_quanta_m(quanta);
    points_.push_back({.along_m = middle.forward.dot(p_m.head<2>()),
                       .lateral_m = middle.forward.x() * p_m.y() - middle.forward.y() * p_m.x(),
                       .height_m = camera_height_m + p_m.z(),
                       .kept = true});
  }
  return plane.slope_per_px() / DisparityTable::kPartsPerQuantum;
}

void ChainEstimator::gather_near_rows(const Scene& scene, std::span<const EdgePixel> chain) {
  near_rows_.clear();
  for (const EdgePixel& pixel : chain) {
    NearRow& row = near_rows_.emplace_back();
    for (int k = 0; k < pixel.near_run_px; ++k) {
      row[static_cast<std::size_t>(k)] =
          scene.table.parts(scene.depth.at(pixel.u_px + k * pixel.inward_px(), pixel.v_px));
    }
  }
}

/// Disparity of the near surface averaged over the rows, by pixels from the row's edge: one row
/// cannot tell what is straight.
ChainEstimator::MeanProfile ChainEstimator::mean_profile(std::span<const EdgePixel> chain) const {
  MeanProfile profile;
  std::array<double, kNearRunMax_px> rows{};
  for (std::size_t i = 0; i < chain.size(); ++i) {
    for (std::size_t k = 1; k < chain[i].near_run_px; ++k) {
      profile.parts[k] += near_rows_[i][k] - near_rows_[i][1];
      rows[k] += 1.0;
    }
  }
  const double rows_min = 0.5 * static_cast<double>(chain.size());
  while (profile.end < rows.size() && rows[profile.end] >= rows_min) {
    profile.parts[profile.end] /= rows[profile.end];
    ++profile.end;
  }
  return profile;
}

/// From pixel `first` on, as far as it goes.
ChainEstimator::Straight ChainEstimator::straight_from(const MeanProfile& profile,
                                                       std::size_t first) {
  constexpr double kBend_parts = 0.4 * DisparityTable::kPartsPerQuantum;
  Straight straight;
  for (std::size_t k = first; k < profile.end; ++k) {
    const double place = static_cast<double>(k);
    const bool is_bent = std::abs(profile.parts[k] - straight.line.at(place)) > kBend_parts;
    if (k >= first + kStraight_px && is_bent) break;
    straight.line.add(place, profile.parts[k]);
  }
  straight.last_px = static_cast<int>(first) - 1 + static_cast<int>(straight.line.count());
  return straight;
}

/// Where the near surface is to be measured. Readings misplaced by matching say of a slanted
/// surface too little slope, so those nearest to the border are left out where the surface goes on
/// straight beyond them. Where it does not, it is the side of something, seen at a grazing angle,
/// that ends after a few pixels: its front must not bend the fit.
ChainEstimator::Inside ChainEstimator::inside_of(std::span<const EdgePixel> chain,
                                                 double misplaced_px) const {
  const MeanProfile profile = mean_profile(chain);
  const auto settled = static_cast<std::size_t>(std::lround(2.0 * misplaced_px));
  const Straight inner = straight_from(profile, std::max<std::size_t>(settled, 1));
  if (inner.line.count() >= kStraight_px &&
      goes_on_to_border(profile.parts[1], inner.line, misplaced_px)) {
    return {static_cast<int>(settled), inner.last_px};
  }
  return {0, std::max<int>(straight_from(profile, 1).last_px, kStraight_px)};
}

/// Over pixels from the row's edge and rows, not columns and rows: where rows are misplaced, a
/// slope by columns comes out too small.
SurfacePlane ChainEstimator::near_plane(std::span<const EdgePixel> chain, const Middle& middle,
                                        const Inside& inside,
                                        const SurfacePlane* trimmed_about) const {
  constexpr double kTrim_parts = 1.5 * DisparityTable::kPartsPerQuantum;
  SurfacePlane plane(inside.first_px, middle.v_px);
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const EdgePixel& pixel = chain[i];
    const int end = std::min<int>(pixel.near_run_px, inside.last_px + 1);
    for (int k = std::max(inside.first_px, first_inside_px(pixel)); k < end; ++k) {
      const double parts = near_rows_[i][static_cast<std::size_t>(k)];
      if (trimmed_about && std::abs(trimmed_about->at(k, pixel.v_px) - parts) > kTrim_parts) {
        continue;
      }
      plane.add(k, pixel.v_px, parts);
    }
  }
  return plane;
}

ChainEstimator::Lines ChainEstimator::fit_lines() const {
  Lines lines;
  lines.height_low_m = points_.front().height_m;
  lines.height_high_m = points_.front().height_m;
  for (const EdgePoint& point : points_) {
    lines.height_low_m = std::min(lines.height_low_m, point.height_m);
    lines.height_high_m = std::max(lines.height_high_m, point.height_m);
    if (!point.kept) continue;
    lines.lateral_m.add(point.height_m, point.lateral_m);
    lines.along_m.add(point.height_m, point.along_m);
  }
  double squares_m2 = 0.0;
  for (const EdgePoint& point : points_) {
    const double error_m = point.lateral_m - lines.lateral_m.at(point.height_m);
    squares_m2 += error_m * error_m;
  }
  lines.lateral_rms_m = std::sqrt(squares_m2 / static_cast<double>(points_.size()));
  return lines;
}

void ChainEstimator::trim(const Lines& lines, double smallest_m) {
  const double largest_m = std::max(smallest_m, 2.0 * lines.lateral_rms_m);
  for (EdgePoint& point : points_) {
    const double error_m = point.lateral_m - lines.lateral_m.at(point.height_m);
    point.kept = std::abs(error_m) <= largest_m;
  }
}

}  // namespace roomwise::landmark
