#include "services/segment_svc/core/color/training.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace roomwise::segment {
namespace {

/// A mixture of few parts needs no more, and a service that is taught must not stand still.
constexpr std::size_t kSamplesMax = 1500;

/// Lamps and shadows change a surface's colour by a few per cent even where it looks plain.
constexpr double kVarianceMin = 1e-3;

/// Index of a class; kTrainedClassCount if the label is none.
std::size_t class_index(int label) {
  const auto found = std::find(kTrainedClasses.begin(), kTrainedClasses.end(), label);
  return static_cast<std::size_t>(found - kTrainedClasses.begin());
}

bool lies_inside(const TrainingRectangle& rectangle, const ColorImage& color) {
  return rectangle.left_px >= 0 && rectangle.top_px >= 0 && rectangle.width_px > 0 &&
         rectangle.height_px > 0 && rectangle.width_px <= color.width_px - rectangle.left_px &&
         rectangle.height_px <= color.height_px - rectangle.top_px;
}

using Colors = std::vector<std::array<std::uint8_t, 3>>;

void add_pixels(const ColorImage& color, const TrainingRectangle& rectangle, Colors& colors) {
  for (int v = rectangle.top_px; v < rectangle.top_px + rectangle.height_px; ++v) {
    const std::uint8_t* pixel =
        color.rgb.data() +
        3 * (static_cast<std::size_t>(v) * static_cast<std::size_t>(color.width_px) +
             static_cast<std::size_t>(rectangle.left_px));
    for (int u = 0; u < rectangle.width_px; ++u, pixel += 3) {
      colors.push_back({pixel[0], pixel[1], pixel[2]});
    }
  }
}

GreyHistogram histogram_of(const Colors& colors) {
  GreyHistogram histogram{};
  for (const auto& [red, green, blue] : colors) ++histogram[grey_level(red, green, blue)];
  return histogram;
}

/// Evenly spread over all pixels.
std::vector<ColorFeature> samples_of(const Colors& colors) {
  const std::size_t step = 1 + (colors.size() - 1) / kSamplesMax;
  std::vector<ColorFeature> samples;
  for (std::size_t i = 0; i < colors.size(); i += step) {
    samples.push_back(color_feature(colors[i][0], colors[i][1], colors[i][2]));
  }
  return samples;
}

bool are_alike(const GreyGaussian& a, const GreyGaussian& b) {
  return a.mean_levels == b.mean_levels && a.sigma_levels == b.sigma_levels;
}

bool has_alike(const GreyClassifier::Gaussians& grey) {
  return are_alike(grey[0], grey[1]) || are_alike(grey[0], grey[2]) || are_alike(grey[1], grey[2]);
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

std::variant<ColorModel, TrainingFault> train(const ColorImage& color,
                                              std::span<const TrainingRectangle> rectangles,
                                              GreyStatistics how) {
  if (color.empty()) return TrainingFault::kNoColor;
  std::array<Colors, kTrainedClassCount> colors;
  for (const TrainingRectangle& rectangle : rectangles) {
    const std::size_t k = class_index(rectangle.label);
    if (k == kTrainedClassCount) return TrainingFault::kUnknownLabel;
    if (!lies_inside(rectangle, color)) return TrainingFault::kOutsideImage;
    add_pixels(color, rectangle, colors[k]);
  }
  GreyClassifier::Gaussians grey;
  std::array<std::optional<Mixture>, kTrainedClassCount> mixtures;
  for (std::size_t k = 0; k < kTrainedClassCount; ++k) {
    if (colors[k].empty()) return TrainingFault::kClassMissing;
    mixtures[k] = fit_best_mixture(samples_of(colors[k]), kMixturePartsMax,
                                   {.gain_min = 1e-4, .variance_min = kVarianceMin});
    if (!mixtures[k]) return TrainingFault::kTooFewPixels;
    grey[k] = *grey_statistics(histogram_of(colors[k]), how);
  }
  if (has_alike(grey)) return TrainingFault::kClassesAlike;
  return ColorModel{.grey = grey, .mixtures = {*mixtures[0], *mixtures[1], *mixtures[2]}};
}

}  // namespace roomwise::segment
