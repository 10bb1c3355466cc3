#include "services/simulator/render/pattern.h"

#include <cmath>
#include <cstdint>

#include "common/multiversion.h"
#include "services/simulator/core/kinect/pixel_hash.h"

namespace roomwise::simulator {
namespace {

constexpr float kWidthLeast = 1e-3F;

inline float larger(float a, float b) { return a > b ? a : b; }
inline float fraction(float x) { return x - std::floor(x); }

/// Integral from 0 to x of the wave that is 1 on [0, 1), -1 on [1, 2), and so on, up to a constant.
inline float square_wave_integral(float x) {
  return 1.0F - 2.0F * std::abs(fraction(0.5F * x) - 0.5F);
}

/// Mean of that wave over a pixel (box filter; closed form after I. Quilez, "Filtering the
/// checkerboard pattern", 2011).
inline float square_wave(float x, float width) {
  const float w = larger(width, kWidthLeast);
  const float near = x - 2.0F * std::floor(0.5F * x);  // far out there are no digits left for w
  return (square_wave_integral(near + 0.5F * w) - square_wave_integral(near - 0.5F * w)) / w;
}

/// 0..1 for a place of a whole-numbered lattice.
inline float lattice(std::int32_t i, std::int32_t j) {
  const std::uint32_t bits =
      hash32(static_cast<std::uint32_t>(i) * 0x9e3779b9U + static_cast<std::uint32_t>(j));
  return static_cast<float>(static_cast<std::int32_t>(bits >> 9)) * 0x1p-23F;
}

inline float eased(float x) { return x * x * (3.0F - 2.0F * x); }

/// Smooth noise of unit lattice, 0..1.
inline float value_noise(float s, float t) {
  const float s_floor = std::floor(s), t_floor = std::floor(t);
  const auto i = static_cast<std::int32_t>(s_floor), j = static_cast<std::int32_t>(t_floor);
  const float a = eased(s - s_floor), b = eased(t - t_floor);
  const float low = lattice(i, j) + a * (lattice(i + 1, j) - lattice(i, j));
  const float high = lattice(i, j + 1) + a * (lattice(i + 1, j + 1) - lattice(i, j + 1));
  return low + b * (high - low);
}

/// `value` fading to its mean as a pixel covers more of its lattice.
inline float faded(float value, float width) {
  const float strength = 1.5F - width;
  const float kept = strength < 0.0F ? 0.0F : strength > 1.0F ? 1.0F : strength;
  return 0.5F + kept * (value - 0.5F);
}

ROOMWISE_MULTIVERSION
void checker(const PatternPlaces& p, int count, float* mix) {
  for (int i = 0; i < count; ++i) {
    mix[i] = 0.5F - 0.5F * square_wave(p.s[i], p.s_width[i]) * square_wave(p.t[i], p.t_width[i]);
  }
}

ROOMWISE_MULTIVERSION
void stripes(const PatternPlaces& p, int count, float* mix) {
  for (int i = 0; i < count; ++i) mix[i] = 0.5F - 0.5F * square_wave(p.s[i], p.s_width[i]);
}

ROOMWISE_MULTIVERSION
void noise(const PatternPlaces& p, int count, float* mix) {
  for (int i = 0; i < count; ++i) {
    mix[i] = faded(value_noise(p.s[i], p.t[i]), larger(p.s_width[i], p.t_width[i]));
  }
}

/// Boards along s, one pattern size wide, each of its own tone, with grain along them.
ROOMWISE_MULTIVERSION
void wood(const PatternPlaces& p, int count, float* mix) {
  constexpr float kGrainAlong = 0.25F, kGrainAcross = 9.0F;
  for (int i = 0; i < count; ++i) {
    const auto board = static_cast<std::int32_t>(std::floor(p.t[i]));
    const float grain = value_noise(kGrainAlong * p.s[i], kGrainAcross * p.t[i]);
    const float grain_width = larger(kGrainAlong * p.s_width[i], kGrainAcross * p.t_width[i]);
    mix[i] = 0.5F * faded(lattice(board, 7), p.t_width[i]) + 0.5F * faded(grain, grain_width);
  }
}

}  // namespace

void pattern_mix(Pattern pattern, const PatternPlaces& places, int count, float* mix) {
  switch (pattern) {
    case Pattern::kChecker:
      return checker(places, count, mix);
    case Pattern::kStripes:
      return stripes(places, count, mix);
    case Pattern::kNoise:
      return noise(places, count, mix);
    case Pattern::kWood:
      return wood(places, count, mix);
    case Pattern::kPlain:
      break;
  }
  for (int i = 0; i < count; ++i) mix[i] = 0.0F;
}

}  // namespace roomwise::simulator
