#include "services/segment_svc/core/fused_labels.h"

#include <algorithm>
#include <cstring>

#include "common/multiversion.h"
#include "services/segment_svc/core/class_prior.h"
#include "services/segment_svc/core/labels.h"

namespace roomwise::segment {
namespace {

constexpr std::size_t kSampleStep_px = 12;  ///< of a 640-wide image
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

ROOMWISE_MULTIVERSION
bool is_all_floor(const std::uint8_t* labels, std::size_t width) {
  std::uint8_t other = 0;
  for (std::size_t u = 0; u < width; ++u) {
    other = static_cast<std::uint8_t>(other | (labels[u] ^ kAccessible));
  }
  return other == 0;
}

/// The first pixel from `from` on that has the label; `width` if there is none.
std::size_t next(const std::uint8_t* labels, std::size_t from, std::size_t width, Label label) {
  const void* found = std::memchr(labels + from, label, width - from);
  return found == nullptr
             ? width
             : static_cast<std::size_t>(static_cast<const std::uint8_t*>(found) - labels);
}

/// Wall where it is likelier than obstacle, among what stands up. `lead`: by how much colour has
/// wall ahead, for each bin.
ROOMWISE_MULTIVERSION
void judge_standing(const std::uint16_t* bins, const float* lead, float lead_if_wall,
                    float lead_if_obstacle, std::size_t width, std::uint8_t* __restrict labels) {
  for (std::size_t u = 0; u < width; ++u) {
    const int label = labels[u];
    const float known = label == kWall ? lead_if_wall : lead_if_obstacle;
    const int judged = known + lead[bins[u]] > 0.0F ? kWall : kObstacle;
    const int if_obstacle = label == kObstacle ? judged : label;
    labels[u] = static_cast<std::uint8_t>(label == kWall ? judged : if_obstacle);
  }
}

}  // namespace

const ClassScores& FusedLabels::RowScores::of(std::uint8_t label) const {
  if (label == kAccessible) return accessible;
  if (label == kObstacle) return obstacle;
  return label == kWall ? wall : unknown;
}

FusedLabels::RowScores FusedLabels::RowScores::probabilities() const {
  return {.obstacle = normalised(obstacle),
          .wall = normalised(wall),
          .accessible = normalised(accessible),
          .unknown = normalised(unknown),
          .judges_floor = judges_floor};
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
  bins_.assign(width, 0);
  for (std::size_t v = 0; v < rows_.size(); ++v) {
    std::uint8_t* row = labels.data() + v * width;
    if (!rows_[v].judges_floor && is_all_floor(row, width)) continue;
    if (color_is_used_) evidence_.bins_of_row(colors_, v, bins_);
    correct_row(width, rows_[v], bins_.data(), row);
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
    const RowScores by_geometry = rows_[v].probabilities();
    for (std::size_t u = step / 2; u < width; u += step) {
      const std::uint8_t label = labels[v * width + u];
      if (label == kUnknown || label == kDropOff) continue;
      const std::uint8_t* rgb = colors_.at(colors, u);
      const ClassScores all = rows_[v].of(label) + evidence_.of(ColorEvidence::bin(rgb));
      evidence_.add(rgb, by_geometry.of(label), normalised(all));
    }
  }
  evidence_.end();
}

void FusedLabels::correct_row(std::size_t width, const RowScores& row, const std::uint16_t* bins,
                              std::uint8_t* labels) const {
  const auto evidence = [&](std::size_t u) {
    return color_is_used_ ? evidence_.of(bins[u]) : ClassScores{};
  };
  static constexpr std::array<float, ColorEvidence::kBins> kNone{};
  judge_standing(bins, color_is_used_ ? evidence_.wall_lead().data() : kNone.data(),
                 row.wall[kWallIndex] - row.wall[kObstacleIndex],
                 row.obstacle[kWallIndex] - row.obstacle[kObstacleIndex], width, labels);
  for (std::size_t u = next(labels, 0, width, kUnknown); u < width;
       u = next(labels, u + 1, width, kUnknown)) {
    labels[u] = sure_standing(row.unknown + evidence(u));
  }
  if (!row.judges_floor) return;
  for (std::size_t u = next(labels, 0, width, kAccessible); u < width;
       u = next(labels, u + 1, width, kAccessible)) {
    if (is_doubtful(row.accessible + evidence(u))) labels[u] = kUnknown;
  }
}

}  // namespace roomwise::segment
