#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/segment_svc/core/grey_gaussians.h"
#include "services/segment_svc/core/labels.h"
#include "services/segment_svc/core/mixture.h"

namespace roomwise::segment {

/// The class of a colour by mixtures of Gaussians, looked up: colours are cut to 5 bits a channel,
/// and each of the 32^3 has its class worked out once. Prior 1/3 each; a colour that even the best
/// class makes improbable is unknown, not a guess.
class ColorTable {
 public:
  using Mixtures = std::array<Mixture, GreyClassifier::kClasses.size()>;

  /// `log_likelihood_min`: below it a colour is unknown.
  ColorTable(const Mixtures& mixtures, double log_likelihood_min);

  Label classify(std::uint8_t red, std::uint8_t green, std::uint8_t blue) const {
    return labels_[index(red, green, blue)];
  }

  /// One label for each pixel; `labels` must have as many as the image.
  void classify(const ColorImage& color, std::span<std::uint8_t> labels) const;

 private:
  static constexpr std::size_t index(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
    return static_cast<std::size_t>((red >> 3U) << 10U | (green >> 3U) << 5U | blue >> 3U);
  }
  std::vector<Label> labels_;  ///< 32 x 32 x 32
};

}  // namespace roomwise::segment
