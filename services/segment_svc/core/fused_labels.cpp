#include "services/segment_svc/core/fused_labels.h"

#include <algorithm>

#include "services/segment_svc/core/class_prior.h"
#include "services/segment_svc/core/labels.h"

namespace roomwise::segment {
namespace {

constexpr std::size_t kSampleStep_px = 8;  ///< of a 640-wide image
/// Ahead of each of the two other classes by ln 18: a probability of at least 0.9.
constexpr float kSureLead = 2.9F;

constexpr std::size_t kObstacleIndex = 0;
constexpr std::size_t kWallIndex = 1;
constexpr std::size_t kAccessibleIndex = 2;

/// The class that is sure, if it stands up; else unknown.
Label sure_standing(const ClassScores& log_scores) {
  const auto [obstacle, wall, accessible] = log_scores;
  if (obstacle >= std::max(wall, accessible) + kSureLead) return kObstacle;
  return wall >= std::max(obstacle, accessible) + kSureLead ? kWall : kUnknown;
}

/// Nearer than this depth decides alone what is floor.
constexpr float kFloorJudgedFrom_m = 2.0F;

/// Floor that is likelier something else.
bool is_doubtful(const ClassScores& log_scores) {
  return std::max(log_scores[kObstacleIndex], log_scores[kWallIndex]) >
         log_scores[kAccessibleIndex];
}

/// What the colours of a row say.
struct WithColor {
  const ColorEvidence& evidence;
  const ColorGrid& grid;
  const std::uint8_t* row;

  std::size_t bin(std::size_t u) const { return ColorEvidence::bin(grid.at(row, u)); }
  const ClassScores& of(std::size_t u) const { return evidence.of(bin(u)); }
  float wall_lead(std::size_t u) const { return evidence.wall_lead(bin(u)); }
};

struct WithoutColor {
  static ClassScores of(std::size_t /*u*/) { return {}; }
  static float wall_lead(std::size_t /*u*/) { return 0.0F; }
};

}  // namespace

const ClassScores& FusedLabels::RowScores::of(std::uint8_t label) const {
  if (label == kAccessible) return accessible;
  if (label == kObstacle) return obstacle;
  return label == kWall ? wall : unknown;
}

void FusedLabels::correct(const RgbdFrame& frame, const CameraView& view, const FloorPlane& floor,
                          std::vector<std::uint8_t>& labels) {
  prepare_rows(view, floor);
  color_is_used_ = !frame.color.empty() && frame.depth_registered;
  if (color_is_used_) {
    colors_.prepare(frame.color, view.width_px(), view.height_px());
    learn(view, labels);
    color_is_used_ = evidence_.reliability_ratio() > 0.0;
  }
  const auto width = static_cast<std::size_t>(view.width_px());
  for (std::size_t v = 0; v < rows_.size(); ++v) {
    std::uint8_t* row = labels.data() + v * width;
    if (color_is_used_) {
      correct_row(width, rows_[v], WithColor{evidence_, colors_, colors_.row(v)}, row);
    } else {
      correct_row(width, rows_[v], WithoutColor{}, row);
    }
  }
}

void FusedLabels::prepare_rows(const CameraView& view, const FloorPlane& floor) {
  const ClassScores obstacle = log_geometry_says(kObstacle);
  const ClassScores wall = log_geometry_says(kWall);
  const ClassScores accessible = log_geometry_says(kAccessible);
  const ClassScores unknown = log_geometry_says(kUnknown);
  rows_.resize(static_cast<std::size_t>(view.height_px()));
  for (int v = 0; v < view.height_px(); ++v) {
    const ClassScores prior = log_location_prior(view, floor, v);
    rows_[static_cast<std::size_t>(v)] = {
        .obstacle = prior + obstacle,
        .wall = prior + wall,
        .accessible = prior + accessible,
        .unknown = prior + unknown,
        .judges_floor = floor_depth_m(view, floor, v) > kFloorJudgedFrom_m};
  }
}

/// A pixel counts for the classes by their probabilities with what was known of colours before.
void FusedLabels::learn(const CameraView& view, const std::vector<std::uint8_t>& labels) {
  const auto width = static_cast<std::size_t>(view.width_px());
  const std::size_t step = std::max<std::size_t>(1, width * kSampleStep_px / 640);
  evidence_.begin();
  for (std::size_t v = step / 2; v < rows_.size(); v += step) {
    const std::uint8_t* colors = colors_.row(v);
    for (std::size_t u = step / 2; u < width; u += step) {
      const std::uint8_t label = labels[v * width + u];
      if (label == kUnknown || label == kDropOff) continue;
      const ClassScores& known = rows_[v].of(label);
      const std::uint8_t* rgb = colors_.at(colors, u);
      const ClassScores all = known + evidence_.of(ColorEvidence::bin(rgb));
      evidence_.add(rgb, normalised(known), normalised(all));
    }
  }
  evidence_.end();
}

template <class Evidence>
void FusedLabels::correct_row(std::size_t width, const RowScores& row, const Evidence& evidence,
                              std::uint8_t* labels) {
  const float lead_if_wall = row.wall[kWallIndex] - row.wall[kObstacleIndex];
  const float lead_if_obstacle = row.obstacle[kWallIndex] - row.obstacle[kObstacleIndex];
  for (std::size_t u = 0; u < width; ++u) {
    const std::uint8_t label = labels[u];
    if (label == kAccessible) {
      if (row.judges_floor && is_doubtful(row.accessible + evidence.of(u))) labels[u] = kUnknown;
    } else if (label == kObstacle || label == kWall) {
      const float lead = label == kWall ? lead_if_wall : lead_if_obstacle;
      labels[u] = lead + evidence.wall_lead(u) > 0.0F ? kWall : kObstacle;
    } else if (label == kUnknown) {
      labels[u] = sure_standing(row.unknown + evidence.of(u));
    }
  }
}

}  // namespace roomwise::segment
