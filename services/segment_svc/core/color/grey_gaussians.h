#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "services/segment_svc/core/labels.h"

namespace roomwise::segment {

/// Number of pixels of each grey level.
using GreyHistogram = std::array<std::int64_t, 256>;

/// Grey level of a colour (ITU-R BT.601 luma, rounded down).
constexpr std::uint8_t grey_level(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  return static_cast<std::uint8_t>((77U * red + 150U * green + 29U * blue) >> 8U);
}

struct GreyGaussian {
  double mean_levels = 0.0;
  double sigma_levels = 1.0;  ///< > 0
};

/// How a training set's mean and sigma are found.
enum class GreyStatistics {
  kAverage,    ///< mean and standard deviation
  kThreshold,  ///< the iterative threshold for the mean, and the deviation from it
};

/// A sigma is at least this: quantisation alone spreads a level by 1 / sqrt(12).
inline constexpr double kSigmaMin_levels = 0.289;

/// The threshold T = (m1 + m2) / 2 with m1, m2 the means of the levels above T and not above it,
/// iterated from the mean to its fixed point (Gonzalez and Woods, Digital Image Processing, section
/// 10.3.2). Where all levels are one, that level. The histogram must not be empty.
double iterative_threshold(const GreyHistogram& histogram);

/// Statistics of a training set; nothing if it has fewer than two pixels.
std::optional<GreyGaussian> grey_statistics(const GreyHistogram& histogram, GreyStatistics how);

/// The thesis's classes (section 4.3): one grey Gaussian each for obstacle, wall and accessible,
/// prior 1/3, and the class of the largest p(grey | class) p(class). p(grey) cancels in the argmax.
class GreyClassifier {
 public:
  using Gaussians = std::array<GreyGaussian, kTrainedClasses.size()>;

  explicit GreyClassifier(const Gaussians& gaussians);

  const Gaussians& gaussians() const { return gaussians_; }
  Label classify(std::uint8_t grey) const { return label_of_grey_[grey]; }

 private:
  Gaussians gaussians_;
  std::array<Label, 256> label_of_grey_{};
};

/// ln p(grey | class): -(grey - mean)^2 / (2 sigma^2) - ln(sigma sqrt(2 pi)).
double log_likelihood(double grey_levels, const GreyGaussian& gaussian);

}  // namespace roomwise::segment
