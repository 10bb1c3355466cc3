#include "tests/segment_svc/models/model_score.h"

#include <algorithm>

namespace roomwise::segment {
namespace {

constexpr std::size_t kFloorIndex = 2;

}  // namespace

void ModelScore::add(const std::vector<std::uint8_t>& labels,
                     const std::vector<std::uint8_t>& truth) {
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const auto* found = std::find(kTrainedClasses.begin(), kTrainedClasses.end(), truth[i]);
    if (found == kTrainedClasses.end()) continue;
    Counts& counts = counts_[static_cast<std::size_t>(found - kTrainedClasses.begin())];
    counts.all += 1.0;
    counts.right += labels[i] == truth[i] ? 1.0 : 0.0;
    counts.called_floor += labels[i] == kAccessible ? 1.0 : 0.0;
  }
}

double ModelScore::floor_iou_ratio() const {
  const Counts& floor = counts_[kFloorIndex];
  return floor.right / (floor.all + counts_[0].called_floor + counts_[1].called_floor);
}

double ModelScore::called_floor_ratio() const {
  return (counts_[0].called_floor + counts_[1].called_floor) / (counts_[0].all + counts_[1].all);
}

double ModelScore::difference_ratio() const {
  double all = 0.0;
  double right = 0.0;
  for (const Counts& counts : counts_) {
    all += counts.all;
    right += counts.right;
  }
  return 1.0 - right / all;
}

double ModelScore::difference_ratio(std::size_t k) const {
  return 1.0 - counts_[k].right / counts_[k].all;
}

}  // namespace roomwise::segment
