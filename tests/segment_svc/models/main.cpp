// How well the models label, as lines of comma-separated values: simulated rooms, whose truth is
// known, and a recorded kitchen with masks of its floor. scripts/experiments makes tables of them.
#include <cstdio>
#include <exception>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "services/segment_svc/core/segmenter.h"
#include "tests/segment_svc/models/largest_rectangle.h"
#include "tests/segment_svc/models/lessons.h"
#include "tests/segment_svc/models/model_score.h"
#include "tests/segment_svc/support/recorded_views.h"
#include "tests/segment_svc/support/simulated_views.h"

namespace {

using namespace roomwise;
using namespace roomwise::segment;

const std::vector<std::string> kTaughtModels = {"gaussian", "mixture", "edges", "fused"};
constexpr int kViews = 40;
constexpr simulator::CameraMount kMount = {.z_m = 0.4, .pitch_down_rad = 0.1};

Segmenter segmenter_of(const std::string& model) {
  SegmentParams params;
  params.model = model;
  return Segmenter(params);
}

/// Rectangles on `count` views of the way: the largest of each class.
Lessons lessons_in(const std::string& room, int count) {
  SimulatedViews views(room);
  Lessons lessons;
  for (const Pose2& pose : views.poses(count)) {
    const LabelledFrame& seen = views.look(pose, kMount);
    std::vector<TrainingRectangle> rectangles;
    for (const Label label : kTrainedClasses) {
      rectangles.push_back(largest_rectangle(seen.truth, seen.frame.depth.width_px,
                                             seen.frame.depth.height_px, label));
    }
    lessons.add(seen.frame.color, rectangles);
  }
  return lessons;
}

ModelScore score(const std::string& room, double lamp_level, const std::string& model,
                 const ColorModel* taught) {
  SimulatedViews views(room, lamp_level);
  Segmenter segmenter = segmenter_of(model);
  if (taught != nullptr) segmenter.learn(*taught);
  ModelScore score;
  Segmentation result;
  for (const Pose2& pose : views.poses(kViews)) {
    const LabelledFrame& seen = views.look(pose, kMount);
    segmenter.segment(seen.frame, result);
    score.add(result.labels, seen.truth);
  }
  return score;
}

void print(const ModelScore& score) {
  std::printf("%.4f,%.5f,%.4f", score.floor_iou_ratio(), score.called_floor_ratio(),
              score.difference_ratio());
  for (std::size_t k = 0; k < kTrainedClasses.size(); ++k) {
    std::printf(",%.4f", score.difference_ratio(k));
  }
  std::printf("\n");
}

constexpr const char* kScoreColumns =
    "floor_iou,called_floor,difference,difference_obstacle,difference_wall,difference_floor";

/// Taught in full light, asked in less and less.
void print_light() {
  std::printf("room,lamp_percent,model,%s\n", kScoreColumns);
  for (const char* room : {"living_room", "apartment", "crowd"}) {
    const ColorModel taught = lessons_in(room, 3).learn();
    for (const int percent : {100, 50, 20, 5, 0}) {
      const auto row = [&](const std::string& name, const std::string& model,
                           const ColorModel* what) {
        std::printf("%s,%d,%s,", room, percent, name.c_str());
        print(score(room, percent / 100.0, model, what));
      };
      row("geometry", "geometry", nullptr);
      for (const std::string& model : kTaughtModels) row(model, model, &taught);
      row("fused untaught", "fused", nullptr);
    }
  }
}

/// Which pictures are taught from, and how mean and sigma are found; asked in the living room.
void print_training() {
  struct Choice {
    const char* name;
    const char* room;
    int views;
  };
  std::printf("taught_on,statistics,model,%s\n", kScoreColumns);
  for (const Choice& choice : {Choice{"one view", "living_room", 1},
                               {"five views", "living_room", 5},
                               {"another room", "apartment", 5}}) {
    const Lessons lessons = lessons_in(choice.room, choice.views);
    const auto row = [&](const char* statistics, const std::string& model,
                         const ColorModel& taught) {
      std::printf("%s,%s,%s,", choice.name, statistics, model.c_str());
      print(score("living_room", 1.0, model, &taught));
    };
    const ColorModel average = lessons.learn(GreyStatistics::kAverage);
    row("average", "gaussian", average);
    row("threshold", "gaussian", lessons.learn(GreyStatistics::kThreshold));
    for (const char* model : {"mixture", "edges", "fused"}) row("average", model, average);
  }
}

/// The thesis's means and sigmas, and the histograms they come from.
void print_statistics() {
  std::printf("taught_on,class,average_mean,average_sigma,threshold_mean,threshold_sigma,pixels\n");
  for (const int views : {1, 5}) {
    const Lessons lessons = lessons_in("living_room", views);
    for (const Label label : kTrainedClasses) {
      const GreyHistogram histogram = lessons.histogram(label);
      const GreyGaussian average = *grey_statistics(histogram, GreyStatistics::kAverage);
      const GreyGaussian threshold = *grey_statistics(histogram, GreyStatistics::kThreshold);
      std::int64_t pixels = 0;
      for (const std::int64_t count : histogram) pixels += count;
      std::printf("%s,%d,%.2f,%.2f,%.2f,%.2f,%lld\n", views == 1 ? "one view" : "five views", label,
                  average.mean_levels, average.sigma_levels, threshold.mean_levels,
                  threshold.sigma_levels, static_cast<long long>(pixels));
    }
  }
}

void print_histograms() {
  std::printf("class,level,share\n");
  const Lessons lessons = lessons_in("living_room", 5);
  for (const Label label : kTrainedClasses) {
    const GreyHistogram histogram = lessons.histogram(label);
    double pixels = 0.0;
    for (const std::int64_t count : histogram) pixels += static_cast<double>(count);
    for (std::size_t level = 0; level < histogram.size(); ++level) {
      std::printf("%d,%zu,%.6f\n", label, level, static_cast<double>(histogram[level]) / pixels);
    }
  }
}

/// On the frame that is taught on: cupboards, table and chair, and the largest piece of floor.
Lessons lessons_in_kitchen() {
  constexpr int kTaughtFrame = 60;
  const RgbdFrame frame = recorded::read_frame(kTaughtFrame, recorded::Mounting(1.2)(kTaughtFrame),
                                               recorded::Color::kRead);
  const auto mask = *recorded::read_floor_mask(kTaughtFrame);
  TrainingRectangle floor =
      largest_rectangle(mask, frame.depth.width_px, frame.depth.height_px, 255);
  floor.label = kAccessible;
  Lessons lessons;
  lessons.add(frame.color, {floor,
                            {kWall, 127, 92, 100, 80},
                            {kObstacle, 425, 291, 50, 31},
                            {kObstacle, 301, 266, 37, 25}});
  return lessons;
}

/// The masks tell floor from all else, and no more.
std::vector<std::uint8_t> truth_of(const std::vector<std::uint8_t>& mask) {
  std::vector<std::uint8_t> truth;
  for (const std::uint8_t value : mask) {
    truth.push_back(value == 255 ? kAccessible : value == 0 ? kObstacle : kUnknown);
  }
  return truth;
}

ModelScore score_kitchen(const std::string& model, double light_ratio, const ColorModel* taught) {
  const recorded::Mounting mounting(1.2);
  Segmenter segmenter = segmenter_of(model);
  if (taught != nullptr) segmenter.learn(*taught);
  ModelScore score;
  Segmentation result;
  for (int i = 0; i < recorded::kFrames; ++i) {
    RgbdFrame frame = recorded::read_frame(i, mounting(i), recorded::Color::kRead);
    for (std::uint8_t& level : frame.color.rgb) {
      level = static_cast<std::uint8_t>(light_ratio * level);
    }
    segmenter.segment(frame, result);
    if (const auto mask = recorded::read_floor_mask(i)) score.add(result.labels, truth_of(*mask));
  }
  return score;
}

void print_recorded() {
  std::printf("light_percent,model,floor_iou,called_floor\n");
  const ColorModel taught = lessons_in_kitchen().learn();
  for (const int percent : {100, 50, 20, 5}) {
    const auto row = [&](const std::string& name, const std::string& model,
                         const ColorModel* what) {
      const ModelScore score = score_kitchen(model, percent / 100.0, what);
      std::printf("%d,%s,%.4f,%.5f\n", percent, name.c_str(), score.floor_iou_ratio(),
                  score.called_floor_ratio());
    };
    row("geometry", "geometry", nullptr);
    for (const std::string& model : kTaughtModels) row(model, model, &taught);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::map<std::string, std::function<void()>> tables = {{"light", print_light},
                                                               {"training", print_training},
                                                               {"statistics", print_statistics},
                                                               {"histograms", print_histograms},
                                                               {"recorded", print_recorded}};
  const auto table = tables.find(argc == 2 ? argv[1] : "");
  if (table == tables.end()) {
    std::fprintf(stderr, "usage: segment_models light|training|statistics|histograms|recorded\n");
    return 2;
  }
  try {
    table->second();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "segment_models: %s\n", error.what());
    return 1;
  }
  return 0;
}
