#pragma once
#include <cstddef>

namespace roomwise::ekf {

/// Two landmarks of the map that are one in the world.
struct LandmarkPair {
  std::size_t recent = 0;  ///< begun later
  std::size_t old = 0;
};

}  // namespace roomwise::ekf
