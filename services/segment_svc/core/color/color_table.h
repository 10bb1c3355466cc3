#pragma once
#include <array>
#include <cstdint>

#include "services/segment_svc/core/color/color_model.h"
#include "services/segment_svc/core/labels.h"

namespace roomwise::segment {

/// The class of a colour by mixtures of Gaussians, looked up: colours are cut to 5 bits a channel,
/// and each of the 32^3 has its class worked out once. Prior 1/3 each; a colour that lies more than
/// five sigmas off every part of every mixture is unknown, not a guess.
class ColorTable {
 public:
  explicit ColorTable(const ClassMixtures& mixtures);

  Label classify(const std::uint8_t* rgb) const {
    return labels_[static_cast<std::size_t>((rgb[0] >> 3U) << 10U | (rgb[1] >> 3U) << 5U |
                                            rgb[2] >> 3U)];
  }

 private:
  std::array<Label, 32 * 32 * 32> labels_{};
};

}  // namespace roomwise::segment
