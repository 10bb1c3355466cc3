#include "services/landmark_svc/core/surface_color.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace roomwise::landmark {
namespace {

ChromaSignature signature_of(std::uint8_t red, std::uint8_t green, std::uint8_t blue, int count) {
  SurfaceColor color(20.0, 4.0);
  const std::uint8_t rgb[3] = {red, green, blue};
  for (int i = 0; i < count; ++i) color.add(rgb);
  return color.signature();
}

RC_GTEST_PROP(SurfaceColor, BrightnessLeavesTheSignature, ()) {
  const auto level = [] { return *rc::gen::inRange<std::uint8_t>(40, 120); };
  const std::uint8_t red = level();
  const std::uint8_t green = level();
  const std::uint8_t blue = level();
  const auto twice = [](std::uint8_t value) { return static_cast<std::uint8_t>(2 * value); };
  const auto dim = signature_of(red, green, blue, 20);
  const auto bright = signature_of(twice(red), twice(green), twice(blue), 20);
  RC_ASSERT(std::abs(dim.red_log - bright.red_log) < 1e-12);
  RC_ASSERT(std::abs(dim.blue_log - bright.blue_log) < 1e-12);
  RC_ASSERT(bright.variance_log2 < dim.variance_log2);
}

TEST(SurfaceColor, DarkSaturatedOrFewPixelsSayNothing) {
  EXPECT_EQ(signature_of(5, 5, 5, 100).variance_log2, ChromaSignature::kNoColorVariance_log2);
  EXPECT_EQ(signature_of(255, 255, 255, 100).variance_log2, ChromaSignature::kNoColorVariance_log2);
  EXPECT_EQ(signature_of(100, 100, 100, 4).variance_log2, ChromaSignature::kNoColorVariance_log2);
  EXPECT_LT(signature_of(100, 100, 100, 5).variance_log2, 0.01);
}

TEST(SurfaceColor, IsTheLogOfTheRatio) {
  const auto signature = signature_of(200, 100, 50, 10);
  EXPECT_NEAR(signature.red_log, std::log(2.0), 1e-12);
  EXPECT_NEAR(signature.blue_log, -std::log(2.0), 1e-12);
}

}  // namespace
}  // namespace roomwise::landmark
