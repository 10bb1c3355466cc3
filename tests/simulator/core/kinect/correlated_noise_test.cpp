#include "services/simulator/core/kinect/correlated_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace roomwise::simulator {
namespace {

constexpr int kNoiseWidth_px = 400;
constexpr int kNoiseHeight_px = 400;

std::vector<float> noise_image(CorrelatedNoise& noise, std::uint32_t key) {
  std::vector<float> image;
  noise.start(key);
  for (int v = 0; v < kNoiseHeight_px; ++v) {
    const float* row = noise.next_row();
    image.insert(image.end(), row, row + kNoiseWidth_px);
  }
  return image;
}

double mean_product(const std::vector<float>& image, int du, int dv) {
  double sum = 0.0;
  int count = 0;
  for (int v = 0; v + dv < kNoiseHeight_px; ++v) {
    for (int u = 0; u + du < kNoiseWidth_px; ++u, ++count) {
      sum += static_cast<double>(image[static_cast<std::size_t>(v * kNoiseWidth_px + u)]) *
             image[static_cast<std::size_t>((v + dv) * kNoiseWidth_px + u + du)];
    }
  }
  return sum / count;
}

TEST(CorrelatedNoise, IsOfUnitVarianceAndAlikeOverItsWindow) {
  CorrelatedNoise noise(kNoiseWidth_px, 9, 7);
  const std::vector<float> image = noise_image(noise, 7);
  for (int lag = 0; lag < 12; ++lag) {
    EXPECT_NEAR(mean_product(image, lag, 0), std::max(0.0, 1.0 - lag / 9.0), 0.06) << lag;
    EXPECT_NEAR(mean_product(image, 0, lag), std::max(0.0, 1.0 - lag / 7.0), 0.06) << lag;
  }
}

TEST(CorrelatedNoise, IsGaussianInItsTails) {
  CorrelatedNoise noise(kNoiseWidth_px, 9, 9);
  const std::vector<float> image = noise_image(noise, 3);
  const auto beyond = [&](float limit) {
    const auto count = std::count_if(image.begin(), image.end(),
                                     [limit](float x) { return x > limit || x < -limit; });
    return static_cast<double>(count) / static_cast<double>(image.size());
  };
  EXPECT_NEAR(beyond(1.0F), 0.317, 0.02);
  EXPECT_NEAR(beyond(2.0F), 0.0455, 0.01);
}

TEST(CorrelatedNoise, TheSameKeyGivesTheSameImageWhateverCameBefore) {
  CorrelatedNoise noise(kNoiseWidth_px, 5, 5);
  const std::vector<float> first = noise_image(noise, 11);
  const std::vector<float> other = noise_image(noise, 12);
  EXPECT_NE(first, other);
  EXPECT_EQ(first, noise_image(noise, 11));
}

TEST(CorrelatedNoise, RefusesWindowsItCannotSum) {
  EXPECT_THROW(CorrelatedNoise(10, 0, 7), std::invalid_argument);
  EXPECT_THROW(CorrelatedNoise(10, 9, 65), std::invalid_argument);
  EXPECT_THROW(CorrelatedNoise(0, 9, 7), std::invalid_argument);
}

}  // namespace
}  // namespace roomwise::simulator
