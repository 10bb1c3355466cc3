#include "services/segment_svc/core/segmenter.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/segment_svc/support/scenes.h"
#include "tests/segment_svc/support/taught.h"

namespace roomwise::segment {
namespace {

SegmentParams gaussian_params() {
  SegmentParams params;
  params.model = "gaussian";
  return params;
}

SegmentParams geometry_params() {
  SegmentParams params;
  params.model = "geometry";
  return params;
}

const GreyClassifier::Gaussians kGaussians = {{{60.0, 20.0}, {195.0, 10.0}, {125.0, 15.0}}};

void expect_finite(const Segmentation& result) {
  EXPECT_TRUE(result.floor.plane.normal.allFinite());
  EXPECT_TRUE(std::isfinite(result.floor.plane.height_m));
  EXPECT_TRUE(std::isfinite(result.floor.plane.pitch_rad()));
  EXPECT_TRUE(std::isfinite(result.floor.plane.roll_rad()));
  for (const BearingBin& bin : result.bearings) {
    EXPECT_GE(bin.free_range_m, 0.0);
    EXPECT_LE(bin.free_range_m, 6.0);
    EXPECT_GE(bin.unknown_ratio, 0.0);
    EXPECT_LE(bin.unknown_ratio, 1.0);
  }
  EXPECT_TRUE(std::isfinite(result.distances.mean_m));
  for (const double share : result.distances.class_fraction) {
    EXPECT_GE(share, 0.0);
    EXPECT_LE(share, 1.0);
  }
  for (const double mean_m : result.distances.class_mean_m) EXPECT_TRUE(std::isfinite(mean_m));
  EXPECT_TRUE(std::isfinite(result.corridor.near_m));
  EXPECT_TRUE(std::isfinite(result.corridor.unknown_ratio));
}

TEST(Segmenter, FrameWithoutReadingsIsAllUnknown) {
  RgbdFrame frame = furnished_frame({.height_m = 0.5});
  std::fill(frame.depth.steps.begin(), frame.depth.steps.end(), std::uint16_t{0});
  std::fill(frame.color.rgb.begin(), frame.color.rgb.end(), std::uint8_t{0});
  for (SegmentParams params : {SegmentParams{}, gaussian_params()}) {
    Segmenter segmenter(params);
    segmenter.learn(taught_greys(kGaussians));
    Segmentation result;
    segmenter.segment(frame, result);
    EXPECT_EQ(count(result.labels, kUnknown), 640 * 480);
    EXPECT_FALSE(result.floor.trusted);
    EXPECT_EQ(result.distances.mean_m, 0.0);
    EXPECT_EQ(result.corridor.near_m, 0.0);
    expect_finite(result);
  }
}

TEST(Segmenter, SameFramesGiveTheSameResults) {
  Segmenter one(SegmentParams{});
  Segmenter two(SegmentParams{});
  Segmentation a;
  Segmentation b;
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    const RgbdFrame frame = furnished_frame({.height_m = 0.5, .pitch_rad = 0.05 * seed}, seed);
    one.segment(frame, a);
    two.segment(frame, b);
    EXPECT_EQ(a.labels, b.labels);
    EXPECT_EQ(a.floor.plane.height_m, b.floor.plane.height_m);
    EXPECT_EQ(a.floor.plane.normal, b.floor.plane.normal);
  }
}

TEST(Segmenter, AnyImageSizeWillDo) {
  Segmenter segmenter(SegmentParams{});
  Segmentation result;
  for (const auto& [width, height] :
       {std::pair{640, 480}, {320, 240}, {160, 120}, {333, 257}, {16, 16}, {17, 300}, {640, 480}}) {
    const RgbdFrame frame = furnished_frame(
        {.width_px = width, .height_px = height, .height_m = 0.5, .pitch_rad = 0.3});
    segmenter.segment(frame, result);
    ASSERT_EQ(result.labels.size(), static_cast<std::size_t>(width * height));
    expect_finite(result);
    if (width >= 160 && width < 640) {
      EXPECT_TRUE(result.floor.trusted) << width;
      EXPECT_GE(floor_iou(frame, result.labels), 0.95) << width;
    }
  }
}

RC_GTEST_PROP(Segmenter, WhateverComesInEveryNumberIsFinite, ()) {
  RgbdFrame frame;
  frame.depth.width_px = *rc::gen::inRange(16, 70);
  frame.depth.height_px = *rc::gen::inRange(16, 70);
  frame.depth.unit_m = *rc::gen::element(1e-9, 1e-4, 1e-3, 0.1);
  const auto pixels = static_cast<std::size_t>(frame.depth.width_px * frame.depth.height_px);
  frame.depth.steps =
      *rc::gen::container<std::vector<std::uint16_t>>(pixels, rc::gen::arbitrary<std::uint16_t>());
  const double focal_px = *rc::gen::element(1.0, 50.0, 585.0, 1e5);
  frame.depth_camera = {focal_px, *rc::gen::element(1.0, 585.0, 1e5),
                        *rc::gen::element(-16.0, 30.0, 32.0), *rc::gen::element(-16.0, 30.0, 32.0)};
  const auto angle = [] { return std::numbers::pi * *rc::gen::inRange(-180, 181) / 180.0; };
  frame.T_robot_camera.linear() = (Eigen::AngleAxisd(angle(), Eigen::Vector3d::UnitZ()) *
                                   Eigen::AngleAxisd(angle(), Eigen::Vector3d::UnitX()) *
                                   Eigen::AngleAxisd(angle(), Eigen::Vector3d::UnitY()))
                                      .toRotationMatrix();
  const auto place = [] { return *rc::gen::element(-100.0, -0.3, 0.0, 0.3, 1.2, 100.0); };
  frame.T_robot_camera.translation() = Eigen::Vector3d(place(), place(), place());
  Segmenter segmenter(SegmentParams{});
  Segmentation result;
  segmenter.segment(frame, result);
  segmenter.segment(frame, result);
  expect_finite(result);
  RC_ASSERT(!testing::Test::HasFailure());
}

TEST(Gaussian, LabelsEveryPixelWithAReadingByItsGrey) {
  const RgbdFrame frame = furnished_frame({.height_m = 0.5, .pitch_rad = 0.3});
  const GreyClassifier classifier(kGaussians);
  for (const bool needs_depth : {true, false}) {
    SegmentParams params = gaussian_params();
    params.color_needs_depth = needs_depth;
    Segmenter segmenter(params);
    segmenter.learn(taught_greys(kGaussians));
    Segmentation result;
    segmenter.segment(frame, result);
    EXPECT_STREQ(segmenter.model_in_force(), "gaussian");
    for (std::size_t i = 0; i < result.labels.size(); ++i) {
      const auto* rgb = frame.color.rgb.data() + 3 * i;
      const bool is_unknown = needs_depth && frame.depth.steps[i] == 0;
      ASSERT_EQ(result.labels[i],
                is_unknown ? kUnknown : classifier.classify(grey_level(rgb[0], rgb[1], rgb[2])));
    }
  }
}

TEST(Gaussian, WithoutTrainingOrColorGeometryLabels) {
  RgbdFrame frame = furnished_frame({.height_m = 0.5, .pitch_rad = 0.3});
  Segmentation geometry;
  Segmenter(geometry_params()).segment(frame, geometry);
  Segmenter untrained(gaussian_params());
  Segmentation result;
  untrained.segment(frame, result);
  EXPECT_STREQ(untrained.model_in_force(), "geometry");
  EXPECT_EQ(result.labels, geometry.labels);

  Segmenter trained(gaussian_params());
  trained.learn(taught_greys(kGaussians));
  frame.color = {};
  trained.segment(frame, result);
  EXPECT_STREQ(trained.model_in_force(), "geometry");
  EXPECT_EQ(result.labels, geometry.labels);
}

TEST(Gaussian, ColorOfAnotherSizeIsThinnedOut) {
  RgbdFrame frame = furnished_frame({.height_m = 0.5, .pitch_rad = 0.3});
  frame.color = {.width_px = 2, .height_px = 1, .rgb = {60, 60, 60, 195, 195, 195}};
  SegmentParams params = gaussian_params();
  params.color_needs_depth = false;
  Segmenter segmenter(params);
  segmenter.learn(taught_greys(kGaussians));
  Segmentation result;
  segmenter.segment(frame, result);
  EXPECT_EQ(result.labels[319], kObstacle);
  EXPECT_EQ(result.labels[320], kWall);
}

TEST(Gaussian, FreeRangeIsGeometrysAllTheSame) {
  const RgbdFrame frame = furnished_frame({.height_m = 0.5, .pitch_rad = 0.3});
  Segmentation geometry;
  Segmentation gaussian;
  Segmenter(geometry_params()).segment(frame, geometry);
  Segmenter segmenter(gaussian_params());
  segmenter.learn(taught_greys({{{0.0, 1.0}, {1.0, 1.0}, {125.0, 99.0}}}));
  segmenter.segment(frame, gaussian);
  EXPECT_NE(gaussian.labels, geometry.labels);
  for (std::size_t k = 0; k < geometry.bearings.size(); ++k) {
    EXPECT_EQ(gaussian.bearings[k].free_range_m, geometry.bearings[k].free_range_m);
  }
  EXPECT_EQ(gaussian.corridor.near_m, geometry.corridor.near_m);
}

}  // namespace
}  // namespace roomwise::segment
