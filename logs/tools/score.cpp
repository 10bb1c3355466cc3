#include "logs/tools/score.h"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>

#include "logs/tools/floor_masks.h"
#include "logs/tools/log_replay.h"
#include "logs/tools/score_landmarks.h"
#include "logs/tools/score_map.h"
#include "logs/tools/score_trajectory.h"
#include "logs/tools/subcommands.h"
#include "logs/tools/true_floor.h"

namespace roomwise {
namespace {

void add_trajectory(const std::string& prefix, const std::optional<TrajectoryScore>& score,
                    Scores& scores) {
  if (!score) return;
  scores.emplace_back(prefix + "ate_raw_m", score->ate_raw_m);
  scores.emplace_back(prefix + "ate_aligned_m", score->ate_aligned_m);
  scores.emplace_back(prefix + "heading_rmse_rad", score->heading_rmse_rad);
  scores.emplace_back(prefix + "poses", static_cast<double>(score->poses));
}

/// Where the filter has just seen something, as filters without poses in between are judged.
void add_trajectory_at_sightings(const Recording& recording, Scores& scores) {
  const auto score =
      score_trajectory(first_after(recording.poses, recording.sightings), recording.truth);
  if (!score) return;
  scores.emplace_back("ate_aligned_at_sightings_m", score->ate_aligned_m);
  scores.emplace_back("heading_rmse_at_sightings_rad", score->heading_rmse_rad);
}

void add_map(const Recording& recording, const std::optional<TrajectoryScore>& trajectory,
             Scores& scores) {
  if (!recording.map) return;
  const std::vector<MapPoint> points = recording.map_points();
  if (trajectory) {
    const MatchedMap matched =
        match_map(points, recording.true_landmarks, trajectory->T_world_map_aligned);
    if (const auto score = score_map(matched, trajectory->T_world_map_raw)) {
      scores.emplace_back("map_raw_m", score->map_raw_m);
      scores.emplace_back("map_aligned_m", score->map_aligned_m);
      scores.emplace_back("map_matched", static_cast<double>(score->matched));
    }
  }
  scores.emplace_back("landmarks", static_cast<double>(points.size()));
}

void add_landmarks(const Recording& recording, Scores& scores) {
  if (recording.seen_frames.empty()) return;
  double seen = 0.0;
  for (const SeenFrame& frame : recording.seen_frames) {
    seen += static_cast<double>(frame.landmarks.size());
  }
  scores.emplace_back("landmarks_per_frame",
                      seen / static_cast<double>(recording.seen_frames.size()));
  const LandmarkScore score = score_landmarks(recording);
  if (recording.true_landmarks.empty() || score.frames == 0) return;
  const auto per_frame = [&](std::size_t count) {
    return static_cast<double>(count) / static_cast<double>(score.frames);
  };
  scores.emplace_back("landmarks_at_rest_per_frame", per_frame(score.seen));
  scores.emplace_back("landmarks_moving_per_frame", per_frame(score.moving));
  scores.emplace_back("landmarks_true_per_frame", per_frame(score.matches.size()));
  scores.emplace_back("landmarks_false_per_frame", score.false_per_frame());
  scores.emplace_back("landmarks_precision", score.precision_ratio());
  scores.emplace_back("landmarks_in_sight_per_frame", per_frame(score.in_sight));
  scores.emplace_back("landmarks_in_sight_found", score.found_ratio());
  scores.emplace_back("landmarks_error_rms_m", score.error_rms_m());
  scores.emplace_back("landmarks_repeat_std_to_2m", score.repeat_std_m(0.0, 2.0));
  scores.emplace_back("landmarks_repeat_std_2m_to_3.5m", score.repeat_std_m(2.0, 3.5));
  scores.emplace_back("landmarks_viewpoint_median_m", score.viewpoint_median_m());
  const char* const kKindNames[] = {"", "edge_left", "edge_right", "convex", "concave", "pole"};
  for (std::int8_t kind = 1; kind <= 5; ++kind) {
    const LandmarkCounts counts = score.of_kind(kind);
    const std::string name = std::string("landmarks_") + kKindNames[kind];
    scores.emplace_back(name + "_per_frame", per_frame(counts.seen));
    scores.emplace_back(name + "_precision", counts.precision_ratio());
  }
}

/// Six decimals, fewer where the rest are 0.
std::string value_text(double value) {
  std::string text = fmt::format("{:.6f}", value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

Scores score_recording(const Recording& recording) {
  Scores scores;
  const auto trajectory = score_trajectory(recording.poses, recording.truth);
  add_trajectory("", trajectory, scores);
  add_trajectory_at_sightings(recording, scores);
  add_trajectory("odometry_", score_trajectory(recording.odometry, recording.truth), scores);
  add_map(recording, trajectory, scores);
  add_landmarks(recording, scores);
  return scores;
}

Scores score_floor(const std::vector<FloorCounts>& frames) {
  if (frames.empty()) return {};
  FloorCounts pooled;
  double iou_sum = 0.0;
  for (const FloorCounts& counts : frames) {
    pooled += counts;
    iou_sum += counts.iou_ratio();
  }
  return {{"floor_iou", pooled.iou_ratio()},
          {"floor_precision", pooled.precision_ratio()},
          {"floor_recall", pooled.recall_ratio()},
          {"nonfloor_called_floor", pooled.nonfloor_called_floor_ratio()},
          {"floor_iou_mean", iou_sum / static_cast<double>(frames.size())},
          {"floor_frames", static_cast<double>(frames.size())}};
}

std::string scores_as_text(const Scores& scores) {
  std::string text;
  for (const auto& [name, value] : scores) text += fmt::format("{} {}\n", name, value_text(value));
  return text;
}

std::string scores_as_json(const Scores& scores) {
  std::string text;
  for (const auto& [name, value] : scores) {
    text += fmt::format("{}\"{}\": {}", text.empty() ? "" : ", ", name, value_text(value));
  }
  return "{" + text + "}\n";
}

namespace {

struct ScoreOptions {
  std::filesystem::path log;
  std::filesystem::path floor_masks;
  bool json = false;
};

void run_score(const ScoreOptions& options) {
  Recording recording;
  TrueFloor true_floor;
  std::optional<FloorMasks> masks;
  if (!options.floor_masks.empty()) masks.emplace(options.floor_masks);
  const LogReading reading = replay_log(options.log, [&](Bus& bus) {
    gather(bus, recording);
    if (masks) {
      masks->gather(bus);
    } else {
      true_floor.gather(bus);
    }
  });
  sort_by_time(recording);
  Scores scores = score_recording(recording);
  const auto& floor = masks ? masks->frames() : true_floor.frames();
  std::ranges::copy(score_floor(floor), std::back_inserter(scores));
  if (!scores.empty()) {
    fmt::print("{}", options.json ? scores_as_json(scores) : scores_as_text(scores));
    std::fflush(stdout);
  }
  reading.raise_complaints(options.log);
  if (scores.empty()) {
    throw std::runtime_error(
        fmt::format("{}: nothing to score: needs POSE or ODOMETRY with TRUTH, LANDMARKS of frames, "
                    "LANDMARK_MAP, or SEGMENTS with TRUE_SEGMENTS or --floor-masks",
                    options.log.string()));
  }
}

}  // namespace

void add_score(CLI::App& parent) {
  CLI::App& command = *parent.add_subcommand(
      "score", "Errors against TRUTH and masks of the floor: a line 'name value' each.");
  const auto options = std::make_shared<ScoreOptions>();
  command.add_option("LOG", options->log, "a log with inputs and outputs")->required();
  command.add_option("--floor-masks", options->floor_masks, "folder of frame-N.floor.png");
  command.add_flag("--json", options->json, "one JSON object instead");
  command.callback([options] { run_score(*options); });
}

}  // namespace roomwise
