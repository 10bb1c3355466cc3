#pragma once
#include <span>
#include <string>
#include <variant>

#include "common/image/rgbd_frame.h"
#include "services/segment_svc/core/color/color_model.h"

namespace roomwise::segment {

/// Pixels of the colour image that a person says are of one class.
struct TrainingRectangle {
  int label = 0;  ///< one of kTrainedClasses
  int left_px = 0;
  int top_px = 0;
  int width_px = 0;
  int height_px = 0;
};

enum class TrainingFault {
  kNoColor,       ///< the frame has no colour image
  kUnknownLabel,  ///< a rectangle's label is not one of the three classes
  kOutsideImage,  ///< a rectangle is empty or reaches out of the image
  kClassMissing,  ///< a class has no rectangle
  kTooFewPixels,  ///< a class has fewer than ten pixels
  kClassesAlike,  ///< two classes have the same mean and sigma: nothing tells them apart
};

/// A fault's name, as it is counted on HEALTH.
const char* name_of(TrainingFault fault);

/// Learns each class's looks from all its rectangles together.
std::variant<ColorModel, TrainingFault> train(const ColorImage& color,
                                              std::span<const TrainingRectangle> rectangles,
                                              GreyStatistics how);

}  // namespace roomwise::segment
