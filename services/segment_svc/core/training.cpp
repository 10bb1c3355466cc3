#include "services/segment_svc/core/training.h"

#include <algorithm>
#include <array>
#include <optional>

namespace roomwise::segment {
namespace {

constexpr std::size_t kClassCount = GreyClassifier::kClasses.size();

/// Index of a class; kClassCount if the label is none.
std::size_t class_index(int label) {
  const auto found =
      std::find(GreyClassifier::kClasses.begin(), GreyClassifier::kClasses.end(), label);
  return static_cast<std::size_t>(found - GreyClassifier::kClasses.begin());
}

bool lies_inside(const TrainingRectangle& rectangle, const ColorImage& color) {
  return rectangle.left_px >= 0 && rectangle.top_px >= 0 && rectangle.width_px > 0 &&
         rectangle.height_px > 0 && rectangle.width_px <= color.width_px - rectangle.left_px &&
         rectangle.height_px <= color.height_px - rectangle.top_px;
}

void add_pixels(const ColorImage& color, const TrainingRectangle& rectangle,
                GreyHistogram& histogram) {
  for (int v = rectangle.top_px; v < rectangle.top_px + rectangle.height_px; ++v) {
    const std::uint8_t* pixel =
        color.rgb.data() +
        3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(color.width_px) +
             static_cast<std::size_t>(rectangle.left_px));
    for (int u = 0; u < rectangle.width_px; ++u, pixel += 3) {
      ++histogram[grey_level(pixel[0], pixel[1], pixel[2])];
    }
  }
}

bool are_alike(const GreyGaussian& a, const GreyGaussian& b) {
  return a.mean_levels == b.mean_levels && a.sigma_levels == b.sigma_levels;
}

}  // namespace

const char* name_of(TrainingFault fault) {
  switch (fault) {
    case TrainingFault::kNoColor:
      return "training_no_color";
    case TrainingFault::kUnknownLabel:
      return "training_unknown_label";
    case TrainingFault::kOutsideImage:
      return "training_outside_image";
    case TrainingFault::kClassMissing:
      return "training_class_missing";
    case TrainingFault::kTooFewPixels:
      return "training_too_few_pixels";
    case TrainingFault::kClassesAlike:
      return "training_classes_alike";
  }
  return "training_fault";
}

std::variant<GreyClassifier::Gaussians, TrainingFault> train(
    const ColorImage& color, std::span<const TrainingRectangle> rectangles, GreyStatistics how) {
  if (color.empty()) return TrainingFault::kNoColor;
  std::array<GreyHistogram, kClassCount> histograms{};
  std::array<bool, kClassCount> is_named{};
  for (const TrainingRectangle& rectangle : rectangles) {
    const std::size_t k = class_index(rectangle.label);
    if (k == kClassCount) return TrainingFault::kUnknownLabel;
    if (!lies_inside(rectangle, color)) return TrainingFault::kOutsideImage;
    add_pixels(color, rectangle, histograms[k]);
    is_named[k] = true;
  }
  GreyClassifier::Gaussians gaussians;
  for (std::size_t k = 0; k < kClassCount; ++k) {
    if (!is_named[k]) return TrainingFault::kClassMissing;
    const std::optional<GreyGaussian> learned = grey_statistics(histograms[k], how);
    if (!learned) return TrainingFault::kTooFewPixels;
    gaussians[k] = *learned;
    for (std::size_t j = 0; j < k; ++j) {
      if (are_alike(gaussians[j], gaussians[k])) return TrainingFault::kClassesAlike;
    }
  }
  return gaussians;
}

}  // namespace roomwise::segment
