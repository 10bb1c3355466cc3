#include "services/simulator/render/pattern.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace roomwise::simulator {
namespace {

constexpr Pattern kPatterns[] = {Pattern::kPlain, Pattern::kChecker, Pattern::kStripes,
                                 Pattern::kWood, Pattern::kNoise};

float mix_at(Pattern pattern, float s, float t, float width) {
  float mix = -1.0F;
  pattern_mix(pattern, {&s, &t, &width, &width}, 1, &mix);
  return mix;
}

/// Mean of the sharp checkerboard over a pixel, by brute force.
double checker_mean(double s, double t, double width) {
  constexpr int kSamples = 200;
  double sum = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    for (int k = 0; k < kSamples; ++k) {
      const double a = s + width * ((i + 0.5) / kSamples - 0.5);
      const double b = t + width * ((k + 0.5) / kSamples - 0.5);
      sum += std::fmod(std::floor(a) + std::floor(b) + 1000.0, 2.0);
    }
  }
  return sum / (kSamples * kSamples);
}

RC_GTEST_PROP(Pattern, CheckerIsAveragedOverThePixel, ()) {
  const double s = *rc::gen::inRange(-500, 500) / 100.0;
  const double t = *rc::gen::inRange(-500, 500) / 100.0;
  const double width = *rc::gen::inRange(2, 500) / 100.0;
  const float mix = mix_at(Pattern::kChecker, static_cast<float>(s), static_cast<float>(t),
                           static_cast<float>(width));
  RC_ASSERT(std::abs(mix - checker_mean(s, t, width)) < 0.02);
}

RC_GTEST_PROP(Pattern, SharesLieBetweenTheTwoColors, ()) {
  const float s = static_cast<float>(*rc::gen::inRange(-100000, 100000)) / 100.0F;
  const float t = static_cast<float>(*rc::gen::inRange(-100000, 100000)) / 100.0F;
  const float width = static_cast<float>(*rc::gen::inRange(0, 10000)) / 1000.0F;
  for (const Pattern pattern : kPatterns) {
    const float mix = mix_at(pattern, s, t, width);
    RC_ASSERT(mix >= -1e-4F);
    RC_ASSERT(mix <= 1.0001F);
  }
}

TEST(Pattern, FarAwayEveryPatternIsOneEvenColor) {
  for (const Pattern pattern : kPatterns) {
    const float even = pattern == Pattern::kPlain ? 0.0F : 0.5F;
    for (const float s : {0.2F, 1.3F, 7.7F})
      EXPECT_NEAR(mix_at(pattern, s, 2.1F, 50.0F), even, 0.02F);
  }
}

TEST(Pattern, ADotOfAPatternIsTheSameInAnyRunOfPixels) {
  float s[40], t[40], width[40], mix[40];
  for (int i = 0; i < 40; ++i) s[i] = 0.37F * static_cast<float>(i), t[i] = 0.7F, width[i] = 0.1F;
  for (const Pattern pattern : kPatterns) {
    pattern_mix(pattern, {s, t, width, width}, 40, mix);
    for (int i = 0; i < 40; ++i) EXPECT_EQ(mix[i], mix_at(pattern, s[i], 0.7F, 0.1F));
  }
}

}  // namespace
}  // namespace roomwise::simulator
