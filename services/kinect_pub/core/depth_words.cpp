#include "services/kinect_pub/core/depth_words.h"

namespace roomwise::kinect {

void unpack_depths(std::span<std::uint16_t> words) {
  for (std::uint16_t& word : words) word = unpack_depth(word).depth_mm;
}

void drop_depths_above(int max_mm, std::span<std::uint16_t> depths_mm) {
  const auto limit = static_cast<std::uint16_t>(max_mm);
  for (std::uint16_t& depth : depths_mm) depth = depth > limit ? std::uint16_t{0} : depth;
}

}  // namespace roomwise::kinect
