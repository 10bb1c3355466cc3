#include "tests/bench/upright_edges.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace roomwise {
namespace {

/// A wall 2 m ahead with a board 1 m ahead in columns [begin, end); the camera looks along robot x.
RgbdFrame board_in(int begin_px, int end_px) {
  RgbdFrame frame;
  frame.depth = {320, 240, 0.001, std::vector<std::uint16_t>(320 * 240, 2000)};
  for (int v = 0; v < 240; ++v) {
    for (int u = begin_px; u < end_px; ++u) {
      frame.depth.steps[static_cast<std::size_t>(v * 320 + u)] = 1000;
    }
  }
  frame.depth_camera = {290.0, 290.0, 159.5, 119.5};
  frame.T_robot_camera = Eigen::Isometry3d::Identity();
  frame.T_robot_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return frame;
}

cv::Mat line(const cv::Rect& where) {
  cv::Mat edges = cv::Mat::zeros(240, 320, CV_8U);
  edges(where) = 255;
  return edges;
}

TEST(UprightEdges, StandWhereTheNearSideIs) {
  const auto places_m = upright_edges_m(line({200, 40, 1, 100}), board_in(200, 260));
  ASSERT_EQ(places_m.size(), 1U);
  EXPECT_NEAR(places_m[0].x(), 1.0, 1e-6);
  EXPECT_NEAR(places_m[0].y(), -(200 - 159.5) / 290.0, 1e-6);
}

TEST(UprightEdges, WhatLiesOrIsShortIsNone) {
  const RgbdFrame frame = board_in(200, 260);
  EXPECT_TRUE(upright_edges_m(line({100, 60, 100, 1}), frame).empty());
  EXPECT_TRUE(upright_edges_m(line({200, 60, 1, 8}), frame).empty());
  EXPECT_TRUE(upright_edges_m(line({190, 60, 20, 40}), frame).empty());
  EXPECT_EQ(upright_edges_m(line({200, 60, 1, 20}), frame).size(), 1U);
}

TEST(UprightEdges, WithoutAReadingThereIsNoPlace) {
  RgbdFrame frame = board_in(200, 260);
  std::fill(frame.depth.steps.begin(), frame.depth.steps.end(), std::uint16_t{0});
  EXPECT_TRUE(upright_edges_m(line({200, 40, 1, 100}), frame).empty());
}

}  // namespace
}  // namespace roomwise
