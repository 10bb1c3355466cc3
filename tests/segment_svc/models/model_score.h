#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "services/segment_svc/core/labels.h"

namespace roomwise::segment {

/// Label images against the truth.
class ModelScore {
 public:
  /// Pixels whose truth is none of kTrainedClasses are left out.
  void add(const std::vector<std::uint8_t>& labels, const std::vector<std::uint8_t>& truth);

  double floor_iou_ratio() const;
  /// Obstacle and wall called floor, of all obstacle and wall.
  double called_floor_ratio() const;
  /// Share of pixels labelled otherwise than the truth: the thesis's difference rate.
  double difference_ratio() const;
  /// The same of one of kTrainedClasses.
  double difference_ratio(std::size_t k) const;

 private:
  struct Counts {
    double all = 0.0;
    double right = 0.0;
    double called_floor = 0.0;
  };
  std::array<Counts, kTrainedClasses.size()> counts_;
};

}  // namespace roomwise::segment
