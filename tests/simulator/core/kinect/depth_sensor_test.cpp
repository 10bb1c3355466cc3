#include "services/simulator/core/kinect/depth_sensor.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/simulator/support/ideal_views.h"

namespace roomwise::simulator {
namespace {

constexpr double kProjector_px_m = 585.0 * 0.075;

/// Nothing but rounding.
DepthSensorParams faultless() {
  return {.depth_noise_quanta = 0.0,
          .depth_pattern_quanta = 0.0,
          .ragged_px = 0.0,
          .light_needed_ratio = 0.0,
          .depth_dropout_ratio = 0.0};
}

DepthImage exposed(const DepthSensorParams& params, const KinectView& view) {
  DepthSensor sensor(params, 1);
  DepthImage image;
  sensor.expose(view, kProjector_px_m, 0, image);
  return image;
}

double readings_ratio(const DepthImage& image) {
  const auto holes = std::count(image.steps.begin(), image.steps.end(), std::uint16_t{0});
  return 1.0 - static_cast<double>(holes) / static_cast<double>(image.size());
}

/// Depths that a sensor tells apart around `depth_m`: the mean step between them.
double step_mm(double depth_m) {
  KinectView ramp = even_view(depth_m);
  for (std::size_t i = 0; i < ramp.size(); ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(ramp.size()) - 0.5;
    ramp.inverse_depth_per_m[i] = static_cast<float>(1.0 / depth_m * (1.0 + 0.2 * share));
  }
  const DepthImage image = exposed(faultless(), ramp);
  std::set<int> near_it;
  for (const std::uint16_t mm : image.steps) {
    if (std::abs(mm / (1000.0 * depth_m) - 1.0) < 0.05) near_it.insert(mm);
  }
  return (*near_it.rbegin() - *near_it.begin()) / static_cast<double>(near_it.size() - 1);
}

TEST(DepthSensor, StepsAreTheSquareOfDepthOver8FB) {
  // What real Kinects show at these depths.
  const std::pair<double, double> measured_mm[] = {
      {1.0, 2.9}, {2.0, 11.5}, {3.0, 26.0}, {3.8, 41.8}};
  for (const auto& [depth_m, expected_mm] : measured_mm) {
    EXPECT_NEAR(step_mm(depth_m), 1000.0 * depth_m * depth_m / (8.0 * 585.0 * 0.075),
                0.02 * expected_mm);
    EXPECT_NEAR(step_mm(depth_m), expected_mm, 0.02 * expected_mm + 0.05);
  }
}

RC_GTEST_PROP(DepthSensor, DepthIsThatOfTheNearestWholeDisparity, ()) {
  const double depth_m = *rc::gen::inRange(510, 7900) / 1000.0;
  const DepthImage image = exposed(faultless(), even_view(depth_m, 64, 48));
  const double quanta = std::round(351.0 / depth_m);
  RC_ASSERT(image.at(10, 10) == std::lround(351000.0 / quanta));
}

RC_GTEST_PROP(DepthSensor, RawShiftsAreOfElevenBitsAndTurnBackIntoQuanta, ()) {
  const auto quanta = *rc::gen::inRange<std::uint16_t>(1, kQuantaMax);
  RC_ASSERT(raw_shift(quanta) < 2047);
  RC_ASSERT(1090 - raw_shift(quanta) == quanta);
  RC_ASSERT(raw_shift(0) == 2047);
}

TEST(DepthSensor, SeesNothingInTheBlindZoneNorBeyondItsRange) {
  EXPECT_EQ(readings_ratio(exposed({}, even_view(0.45))), 0.0);
  EXPECT_GT(readings_ratio(exposed({}, even_view(0.55))), 0.97);
  EXPECT_GT(readings_ratio(exposed({}, even_view(7.0))), 0.9);
  EXPECT_EQ(readings_ratio(exposed({}, even_view(9.0))), 0.0);
}

TEST(DepthSensor, NeedsLight) {
  KinectView view = even_view(2.0);
  std::fill(view.infrared_ratio.begin(), view.infrared_ratio.end(), 0.001F);
  EXPECT_EQ(readings_ratio(exposed({}, view)), 0.0);
  std::fill(view.infrared_ratio.begin(), view.infrared_ratio.end(), 0.006F);
  EXPECT_NEAR(readings_ratio(exposed({}, view)), 0.5, 0.1);  // ragged patches of both
}

TEST(DepthSensor, DropsAboutTheShareOfPatchesItIsTold) {
  DepthSensorParams params = faultless();
  params.depth_dropout_ratio = 0.05;
  const double blind_ratio = 8.0 / 640.0;
  EXPECT_NEAR(readings_ratio(exposed(params, even_view(2.0))), 0.95 * (1.0 - blind_ratio), 0.01);
}

TEST(DepthSensor, LeavesTheLastColumnsOfARowBlank) {
  for (const int width_px : {640, 320}) {
    const DepthImage image = exposed(faultless(), even_view(2.0, width_px, width_px * 3 / 4));
    const int blind_px = 8 * width_px / 640;
    EXPECT_EQ(image.at(width_px - blind_px, 5), 0);
    EXPECT_NE(image.at(width_px - blind_px - 1, 5), 0);
  }
}

TEST(DepthSensor, ShadowIsAsWideAsDisparitiesDifferAndOnlyToTheLeft) {
  for (const int width_px : {640, 320}) {
    KinectView view = even_view(3.0, width_px, width_px * 3 / 4);
    const int begin = width_px * 3 / 8, end = width_px * 5 / 8, v = 100;
    for (int u = begin; u < end; ++u) {
      for (int row = 0; row < view.height_px; ++row) {
        view.inverse_depth_per_m[static_cast<std::size_t>(row * width_px + u)] = 1.0F;
      }
    }
    DepthSensor sensor(faultless(), 1);
    DepthImage image;
    const double projector_px_m = kProjector_px_m * width_px / 640.0;
    sensor.expose(view, projector_px_m, 0, image);
    int dark_left = 0, dark_right = 0;
    for (int u = 0; u < begin; ++u) dark_left += image.at(u, v) == 0;
    for (int u = begin; u < width_px - 8; ++u) dark_right += image.at(u, v) == 0;
    EXPECT_NEAR(dark_left, projector_px_m * (1.0 / 1.0 - 1.0 / 3.0), 1.0);
    EXPECT_EQ(dark_right, 0);
  }
}

TEST(DepthSensor, TheSameSeedAndFrameGiveTheSameBytesWhateverCameBefore) {
  const KinectView view = even_view(3.0);
  DepthSensor sensor({}, 5), other({}, 5), stranger({}, 6);
  DepthImage image, again, strange;
  sensor.expose(view, kProjector_px_m, 0, image);
  sensor.expose(view, kProjector_px_m, 1, image);
  other.expose(view, kProjector_px_m, 1, again);
  stranger.expose(view, kProjector_px_m, 1, strange);
  EXPECT_EQ(image.steps, again.steps);
  EXPECT_NE(image.steps, strange.steps);
}

}  // namespace
}  // namespace roomwise::simulator
