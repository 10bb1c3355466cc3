#pragma once
#include <span>
#include <string>
#include <variant>

#include "common/image/rgbd_frame.h"
#include "services/segment_svc/core/grey_gaussians.h"

namespace roomwise::segment {

/// Pixels of the colour image that a person says are of one class.
struct TrainingRectangle {
  int label = 0;  ///< a Label of GreyClassifier::kClasses
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
  kTooFewPixels,  ///< a class has fewer than two pixels
  kClassesAlike,  ///< two classes have the same mean and sigma: nothing tells them apart
};

/// A fault's name, as it is counted on HEALTH.
const char* name_of(TrainingFault fault);

/// Learns a Gaussian per class from all its rectangles together.
std::variant<GreyClassifier::Gaussians, TrainingFault> train(
    const ColorImage& color, std::span<const TrainingRectangle> rectangles, GreyStatistics how);

}  // namespace roomwise::segment
