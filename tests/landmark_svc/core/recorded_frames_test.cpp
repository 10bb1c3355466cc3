#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "services/landmark_svc/core/landmark_detector.h"
#include "tests/support/shared_data.h"

namespace roomwise::landmark {
namespace {

constexpr const char* kFolder = "rgbd_7scenes_redkitchen_000_119";

std::string file_of(int frame, const char* ending) {
  char name[64];
  std::snprintf(name, sizeof name, "frame-%06d.%s", frame, ending);
  return (shared_data() / kFolder / name).string();
}

/// Camera mounting that turns the recorded camera upright: gravity down, its heading forward.
Eigen::Isometry3d upright(int frame) {
  Eigen::Vector3d down_world;
  std::ifstream(shared_data() / kFolder / "gravity-direction.txt") >> down_world.x() >>
      down_world.y() >> down_world.z();
  Eigen::Matrix4d T_world_camera;
  std::ifstream pose(file_of(frame, "pose.txt"));
  for (int i = 0; i < 16; ++i) pose >> T_world_camera(i / 4, i % 4);
  const Eigen::Vector3d up =
      -(T_world_camera.topLeftCorner<3, 3>().transpose() * down_world).normalized();
  const Eigen::Vector3d ahead = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d forward = (ahead - ahead.dot(up) * up).normalized();
  Eigen::Isometry3d T_robot_camera = Eigen::Isometry3d::Identity();
  T_robot_camera.linear().row(0) = forward;
  T_robot_camera.linear().row(1) = up.cross(forward);
  T_robot_camera.linear().row(2) = up;
  T_robot_camera.translation().z() = 1.4;
  return T_robot_camera;
}

RgbdFrame recorded(int frame) {
  RgbdFrame result;
  const cv::Mat depth = cv::imread(file_of(frame, "depth.png"), cv::IMREAD_UNCHANGED);
  result.depth = {.width_px = depth.cols, .height_px = depth.rows, .unit_m = 0.001, .steps = {}};
  result.depth.steps.assign(depth.begin<std::uint16_t>(), depth.end<std::uint16_t>());
  result.depth_camera = {585.0, 585.0, 320.0, 240.0};
  result.T_robot_camera = upright(frame);
  return result;
}

struct Totals {
  std::int64_t edges_fewest = 1 << 30;
  std::int64_t floor_pixels = 0;
  std::int64_t floor_edges = 0;
  std::int64_t landmarks = 0;
  std::int64_t frames = 0;
};

Totals run(const LandmarkParams& params) {
  LandmarkDetector detector(params);
  Totals totals;
  for (int frame = 0; frame < 120; frame += 5, ++totals.frames) {
    EXPECT_EQ(detector.detect(recorded(frame)), DetectResult::kOk);
    // Interior: 5 px from where the mask ends, beyond any doubt about where a table leg starts.
    cv::Mat floor = cv::imread(file_of(frame, "floor.png"), cv::IMREAD_GRAYSCALE) == 255;
    cv::erode(floor, floor, cv::Mat::ones(11, 11, CV_8U));
    totals.floor_pixels += cv::countNonZero(floor);
    for (const EdgePixel& edge : detector.edges()) {
      totals.floor_edges += floor.at<std::uint8_t>(edge.v_px, edge.u_px) != 0 ? 1 : 0;
    }
    const auto edges = static_cast<std::int64_t>(detector.edges().size());
    totals.edges_fewest = std::min(totals.edges_fewest, edges);
    totals.landmarks += static_cast<std::int64_t>(detector.landmarks().size());
  }
  return totals;
}

TEST(RecordedFrames, FloorMakesNoEdgesAndFurnitureDoes) {
  ROOMWISE_NEED_DATA(kFolder);
  const Totals totals = run({});
  ASSERT_GT(totals.floor_pixels, 100000);
  EXPECT_LT(static_cast<double>(totals.floor_edges),
            1e-5 * static_cast<double>(totals.floor_pixels));
  EXPECT_GT(totals.edges_fewest, 1000);
  EXPECT_GE(totals.landmarks, 4 * totals.frames);
  RecordProperty("landmarks", static_cast<int>(totals.landmarks));
}

TEST(RecordedFrames, SlopeDifferenceDoesFireOnTheFloor) {
  ROOMWISE_NEED_DATA(kFolder);
  LandmarkParams params;
  params.method = "thesis";
  params.slope.threshold_mm_per_px = 0.0;
  const Totals totals = run(params);
  EXPECT_GT(static_cast<double>(totals.floor_edges),
            0.05 * static_cast<double>(totals.floor_pixels));
}

}  // namespace
}  // namespace roomwise::landmark
