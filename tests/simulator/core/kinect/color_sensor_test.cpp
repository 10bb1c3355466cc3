#include "services/simulator/core/kinect/color_sensor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/simulator/support/ideal_views.h"

namespace roomwise::simulator {
namespace {

/// Lamps that neither swing nor flicker.
ColorSensorParams steady() { return {.color_flicker_ratio = 0.0, .lamp_roll_ratio = 0.0}; }

KinectView lit(double light) {
  KinectView view = even_view(2.0, 320, 240);
  for (auto* plane : {&view.red, &view.green, &view.blue}) {
    plane->assign(view.size(), static_cast<float>(light));
  }
  return view;
}

struct Levels {
  double mean = 0.0;
  double sigma = 0.0;
};

Levels levels_of(const ColorImage& image) {
  double sum = 0.0, squares = 0.0;
  for (const std::uint8_t level : image.rgb) sum += level, squares += level * level;
  const auto count = static_cast<double>(image.rgb.size());
  return {sum / count, std::sqrt(squares / count - sum / count * sum / count)};
}

/// After exposure has settled on `light`.
Levels settled(double light) {
  ColorSensor sensor(steady(), 1);
  ColorImage image;
  sensor.expose(lit(light), 0, 0.0, image);
  return levels_of(image);
}

TEST(ColorSensor, ExposureBringsLightAndDimRoomsToTheSameLevel) {
  const double expected = 255.0 * (std::sqrt(0.18 + 0.01) - 0.1) / (std::sqrt(1.01) - 0.1);
  for (const double light : {0.03, 0.1, 0.5, 0.9}) {
    EXPECT_NEAR(settled(light).mean, expected, 1.0) << light;
  }
}

TEST(ColorSensor, ADarkRoomStaysDarkAndNoisy) {
  const Levels dark = settled(0.005), bright = settled(0.5);
  EXPECT_LT(dark.mean, 0.5 * bright.mean);
  EXPECT_NEAR(bright.sigma, 1.6 * std::sqrt(0.18 / 0.5), 0.15);
  EXPECT_NEAR(dark.sigma, 1.6 * std::sqrt(8.0), 0.25);
}

TEST(ColorSensor, ExposureFollowsALampInSmallSteps) {
  ColorSensor sensor(steady(), 1);
  ColorImage image;
  sensor.expose(lit(0.5), 0, 0.0, image);
  const double before = sensor.gain();
  sensor.expose(lit(0.05), 1, 0.0, image);
  EXPECT_NEAR(sensor.gain(), 1.04 * before, 1e-9);
  for (int i = 2; i < 100; ++i) sensor.expose(lit(0.05), i, 0.0, image);
  EXPECT_NEAR(sensor.gain(), 10.0 * before, 1e-6);
}

TEST(ColorSensor, LampsRollWithinTheirBounds) {
  const ColorSensorParams params;
  double least = 2.0, most = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const double factor = lamp_factor(params, 0.033 * i, 0.5);
    least = std::min(least, factor);
    most = std::max(most, factor);
  }
  const double reach = (1.0 + params.lamp_roll_ratio) * (1.0 + params.color_flicker_ratio) - 1.0;
  EXPECT_LE(most, 1.0 + reach + 1e-12);
  EXPECT_GE(least, 1.0 - reach - 1e-12);
  EXPECT_GT(most - least, reach);
  EXPECT_EQ(lamp_factor(steady(), 3.0, 0.2), 1.0);
}

TEST(ColorSensor, NoiseOfTheThreeColorsAndOfNeighboursIsIndependent) {
  ColorSensor sensor(steady(), 1);
  ColorImage image;
  sensor.expose(lit(0.1), 0, 0.0, image);
  const Levels levels = levels_of(image);
  for (const std::size_t apart : {1U, 2U, 3U, 6U}) {
    double sum = 0.0;
    for (std::size_t i = 0; i + apart < image.rgb.size(); ++i) {
      sum += (image.rgb[i] - levels.mean) * (image.rgb[i + apart] - levels.mean);
    }
    const double correlation =
        sum / static_cast<double>(image.rgb.size()) / (levels.sigma * levels.sigma);
    EXPECT_NEAR(correlation, 0.0, 0.02) << apart;
  }
}

TEST(ColorSensor, TheSameSeedGivesTheSameBytes) {
  ColorSensor sensor({}, 5), other({}, 5), stranger({}, 6);
  ColorImage image, again, strange;
  for (int frame = 0; frame < 3; ++frame) {
    sensor.expose(lit(0.2), frame, 0.1 * frame, image);
    other.expose(lit(0.2), frame, 0.1 * frame, again);
    stranger.expose(lit(0.2), frame, 0.1 * frame, strange);
    EXPECT_EQ(image.rgb, again.rgb);
    EXPECT_NE(image.rgb, strange.rgb);
  }
}

}  // namespace
}  // namespace roomwise::simulator
