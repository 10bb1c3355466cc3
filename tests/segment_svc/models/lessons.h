#pragma once
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/segment_svc/core/color/training.h"

namespace roomwise::segment {

/// Pictures one below another, with the rectangles drawn on them: training takes one picture.
class Lessons {
 public:
  /// Pictures must be of one width. Rectangles without area are left out.
  void add(const ColorImage& picture, const std::vector<TrainingRectangle>& rectangles);

  /// Throws std::runtime_error naming what training found wrong.
  ColorModel learn(GreyStatistics how = GreyStatistics::kAverage) const;
  /// Grey levels of one class's rectangles.
  GreyHistogram histogram(int label) const;

 private:
  ColorImage pictures_;
  std::vector<TrainingRectangle> rectangles_;
};

}  // namespace roomwise::segment
