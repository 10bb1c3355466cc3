#include "logs/tools/score_floor.h"

#include "roomwise/segmentation_t.hpp"

namespace roomwise {
namespace {

constexpr int kMaskFloor = 255;
constexpr int kMaskOther = 0;

double ratio(std::int64_t part, std::int64_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0.0;
}

void count_pixel(bool is_floor, bool called_floor, FloorCounts& counts) {
  if (is_floor) {
    ++(called_floor ? counts.floor_called_floor : counts.floor_called_other);
  } else {
    ++(called_floor ? counts.other_called_floor : counts.other_called_other);
  }
}

}  // namespace

FloorCounts& FloorCounts::operator+=(const FloorCounts& more) {
  floor_called_floor += more.floor_called_floor;
  floor_called_other += more.floor_called_other;
  other_called_floor += more.other_called_floor;
  other_called_other += more.other_called_other;
  return *this;
}

double FloorCounts::iou_ratio() const {
  return ratio(floor_called_floor, floor_called_floor + floor_called_other + other_called_floor);
}
double FloorCounts::precision_ratio() const {
  return ratio(floor_called_floor, floor_called_floor + other_called_floor);
}
double FloorCounts::recall_ratio() const {
  return ratio(floor_called_floor, floor_called_floor + floor_called_other);
}
double FloorCounts::nonfloor_called_floor_ratio() const {
  return ratio(other_called_floor, other_called_floor + other_called_other);
}

FloorCounts count_floor(const cv::Mat1b& labels, const cv::Mat1b& mask) {
  FloorCounts counts;
  for (int v = 0; v < mask.rows; ++v) {
    const int label_v = v * labels.rows / mask.rows;
    for (int u = 0; u < mask.cols; ++u) {
      const int truth = mask(v, u);
      if (truth != kMaskFloor && truth != kMaskOther) continue;
      const int label = labels(label_v, u * labels.cols / mask.cols);
      count_pixel(truth == kMaskFloor, label == segmentation_t::LABEL_ACCESSIBLE, counts);
    }
  }
  return counts;
}

}  // namespace roomwise
