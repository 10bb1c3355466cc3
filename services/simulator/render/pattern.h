#pragma once

#include "services/simulator/core/scene.h"

namespace roomwise::simulator {

/// Where a run of pixels is on the pattern of its surface. All in units of the pattern's size,
/// shape: count.
struct PatternPlaces {
  const float* s;        ///< first texture coordinate
  const float* t;        ///< second
  const float* s_width;  ///< how much of it one pixel covers
  const float* t_width;
};

/// Share of the second colour, 0..1, in each of `count` pixels. The pattern is averaged over the
/// pixel, exactly for checkers and stripes and nearly for the others, so that far away it turns
/// into one even colour instead of flickering.
void pattern_mix(Pattern pattern, const PatternPlaces& places, int count, float* mix);

}  // namespace roomwise::simulator
