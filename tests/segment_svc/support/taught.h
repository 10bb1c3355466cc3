#pragma once
#include <algorithm>
#include <cmath>

#include "services/segment_svc/core/color/color_model.h"

namespace roomwise::segment {

/// A mixture of one round part around a colour.
inline Mixture around(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  return Mixture({{.mean = color_feature(red, green, blue),
                   .covariance = 0.005 * Eigen::Matrix3d::Identity()}});
}

/// Classes told by their grey alone.
inline ColorModel taught_greys(const GreyClassifier::Gaussians& grey) {
  const auto mixture = [&](std::size_t k) {
    const auto level = static_cast<std::uint8_t>(std::lround(grey[k].mean_levels));
    return around(level, level, level);
  };
  return {.grey = grey, .mixtures = {mixture(0), mixture(1), mixture(2)}};
}

}  // namespace roomwise::segment
