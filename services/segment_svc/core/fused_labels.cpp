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

Label likelier_standing(const ClassScores& log_scores) {
  return log_scores[kWallIndex] > log_scores[kObstacleIndex] ? kWall : kObstacle;
}

bool is_judged(std::uint8_t label) { return label != kDropOff; }

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
    correct_row(width, rows_[v], color_is_used_ ? colors_.row(v) : nullptr,
                labels.data() + v * width);
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
    rows_[static_cast<std::size_t>(v)] = {.obstacle = prior + obstacle,
                                          .wall = prior + wall,
                                          .accessible = prior + accessible,
                                          .unknown = prior + unknown};
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
      if (label == kUnknown || !is_judged(label)) continue;
      const ClassScores& known = rows_[v].of(label);
      evidence_.add(colors_.at(colors, u), normalised(known),
                    normalised(known + evidence_at(colors, u)));
    }
  }
  evidence_.end();
}

ClassScores FusedLabels::evidence_at(const std::uint8_t* colors, std::size_t u) const {
  if (colors == nullptr) return {};
  return evidence_.of(ColorEvidence::bin(colors_.at(colors, u)));
}

void FusedLabels::correct_row(std::size_t width, const RowScores& row, const std::uint8_t* colors,
                              std::uint8_t* labels) const {
  for (std::size_t u = 0; u < width; ++u) {
    const std::uint8_t label = labels[u];
    if (!is_judged(label)) continue;
    const ClassScores scores = row.of(label) + evidence_at(colors, u);
    if (label == kObstacle || label == kWall) {
      labels[u] = likelier_standing(scores);
    } else if (label == kUnknown) {
      labels[u] = sure_standing(scores);
    } else if (std::max(scores[kObstacleIndex], scores[kWallIndex]) > scores[kAccessibleIndex]) {
      labels[u] = kUnknown;
    }
  }
}

}  // namespace roomwise::segment
