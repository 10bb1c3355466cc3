#include "tests/segment_svc/support/recorded_views.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "tests/support/shared_data.h"

namespace roomwise::segment::recorded {
namespace {

std::filesystem::path file(int number, const std::string& ending) {
  std::string digits = std::to_string(number);
  digits.insert(0, 6 - digits.size(), '0');
  return shared_data() / kFolder / ("frame-" + digits + "." + ending);
}

Eigen::Isometry3d camera_pose(int number) {
  std::ifstream text(file(number, "pose.txt"));
  Eigen::Matrix4d matrix;
  for (Eigen::Index row = 0; row < 4; ++row) {
    for (Eigen::Index column = 0; column < 4; ++column) text >> matrix(row, column);
  }
  Eigen::Isometry3d pose;
  pose.linear() = Eigen::Quaterniond(matrix.topLeftCorner<3, 3>()).normalized().toRotationMatrix();
  pose.translation() = matrix.topRightCorner<3, 1>();
  return pose;
}

ColorImage read_color(int number) {
  cv::Mat3b image = cv::imread(file(number, "color.jpg").string(), cv::IMREAD_COLOR);
  cv::cvtColor(image, image, cv::COLOR_BGR2RGB);
  return {.width_px = image.cols,
          .height_px = image.rows,
          .rgb = std::vector<std::uint8_t>(image.data, image.data + image.total() * 3)};
}

}  // namespace

Mounting::Mounting(double height_m) : height_m_(height_m) {
  std::ifstream text(shared_data() / kFolder / "gravity-direction.txt");
  Eigen::Vector3d down;
  text >> down[0] >> down[1] >> down[2];
  level_ = Eigen::Quaterniond::FromTwoVectors(down, -Eigen::Vector3d::UnitZ());
  first_m_ = (level_ * camera_pose(0).translation()).z();
}

Eigen::Isometry3d Mounting::operator()(int number) const {
  const Eigen::Isometry3d pose = level_ * camera_pose(number);
  const double heading_rad = std::atan2(pose.linear()(1, 2), pose.linear()(0, 2));
  Eigen::Isometry3d T_robot_camera = Eigen::Isometry3d::Identity();
  T_robot_camera.linear() =
      Eigen::AngleAxisd(-heading_rad, Eigen::Vector3d::UnitZ()) * pose.linear();
  T_robot_camera.translation().z() = height_m_ + pose.translation().z() - first_m_;
  return T_robot_camera;
}

RgbdFrame read_frame(int number, const Eigen::Isometry3d& T_robot_camera, Color color) {
  const cv::Mat1w image = cv::imread(file(number, "depth.png").string(), cv::IMREAD_UNCHANGED);
  RgbdFrame frame;
  frame.depth.width_px = image.cols;
  frame.depth.height_px = image.rows;
  frame.depth.steps.assign(image.begin(), image.end());
  for (std::uint16_t& step : frame.depth.steps) step = step == 65535 ? 0 : step;
  frame.depth_camera = {585.0, 585.0, 320.0, 240.0};
  frame.T_robot_camera = T_robot_camera;
  if (color == Color::kRead) frame.color = read_color(number);
  frame.depth_registered = true;
  return frame;
}

std::optional<std::vector<std::uint8_t>> read_floor_mask(int number) {
  if (!std::filesystem::exists(file(number, "floor.png"))) return std::nullopt;
  const cv::Mat1b mask = cv::imread(file(number, "floor.png").string(), cv::IMREAD_GRAYSCALE);
  return std::vector<std::uint8_t>(mask.begin(), mask.end());
}

}  // namespace roomwise::segment::recorded
