#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "services/segment_svc/core/segmenter.h"
#include "tests/support/shared_data.h"

namespace roomwise::segment {
namespace {

constexpr const char* kRecording = "rgbd_7scenes_redkitchen_000_119";
constexpr int kFrames = 120;

std::filesystem::path file(int number, const std::string& ending) {
  std::string digits = std::to_string(number);
  digits.insert(0, 6 - digits.size(), '0');
  return shared_data() / kRecording / ("frame-" + digits + "." + ending);
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

/// Camera poses in a world whose z is up, as gravity has it; the first one `height_m` up.
class Mounting {
 public:
  explicit Mounting(double height_m) : height_m_(height_m) {
    std::ifstream text(shared_data() / kRecording / "gravity-direction.txt");
    Eigen::Vector3d down;
    text >> down[0] >> down[1] >> down[2];
    level_ = Eigen::Quaterniond::FromTwoVectors(down, -Eigen::Vector3d::UnitZ());
    first_m_ = (level_ * camera_pose(0).translation()).z();
  }

  Eigen::Isometry3d operator()(int number) const {
    const Eigen::Isometry3d pose = level_ * camera_pose(number);
    const double heading_rad = std::atan2(pose.linear()(1, 2), pose.linear()(0, 2));
    Eigen::Isometry3d T_robot_camera = Eigen::Isometry3d::Identity();
    T_robot_camera.linear() =
        Eigen::AngleAxisd(-heading_rad, Eigen::Vector3d::UnitZ()) * pose.linear();
    T_robot_camera.translation().z() = height_m_ + pose.translation().z() - first_m_;
    return T_robot_camera;
  }

 private:
  double height_m_;
  double first_m_ = 0.0;
  Eigen::Quaterniond level_;
};

RgbdFrame read_frame(int number, const Eigen::Isometry3d& T_robot_camera) {
  const cv::Mat1w image = cv::imread(file(number, "depth.png").string(), cv::IMREAD_UNCHANGED);
  RgbdFrame frame;
  frame.depth.width_px = image.cols;
  frame.depth.height_px = image.rows;
  frame.depth.steps.assign(image.begin(), image.end());
  for (std::uint16_t& step : frame.depth.steps) step = step == 65535 ? 0 : step;
  frame.depth_camera = {585.0, 585.0, 320.0, 240.0};
  frame.T_robot_camera = T_robot_camera;
  return frame;
}

struct FloorCounts {
  double right = 0.0;
  double missed = 0.0;
  double missed_as_standing = 0.0;  // of those, called obstacle or wall
  double wrong = 0.0;
  double other = 0.0;
  double iou() const { return right / (right + missed + wrong); }
};

void add(const std::vector<std::uint8_t>& labels, const cv::Mat1b& mask, FloorCounts& counts) {
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const bool is_called = labels[i] == kAccessible;
    if (mask.data[i] == 255) ++(is_called ? counts.right : counts.missed);
    const bool stands = labels[i] == kObstacle || labels[i] == kWall;
    if (mask.data[i] == 255 && stands) ++counts.missed_as_standing;
    if (mask.data[i] == 0) ++(is_called ? counts.wrong : counts.other);
  }
}

/// One segmenter that is told its camera starts at this height.
struct Claim {
  explicit Claim(double claimed_height_m) : height_m(claimed_height_m), mounting(height_m) {}

  double height_m;
  Mounting mounting;
  Segmenter segmenter{SegmentParams{}};
  Segmentation result;
  FloorCounts counts;
};

/// Each image is read once for all of them.
void score(std::vector<Claim>& claims) {
  for (int i = 0; i < kFrames; ++i) {
    RgbdFrame frame = read_frame(i, Eigen::Isometry3d::Identity());
    const bool has_mask = std::filesystem::exists(file(i, "floor.png"));
    const cv::Mat1b mask =
        has_mask ? cv::imread(file(i, "floor.png").string(), cv::IMREAD_GRAYSCALE) : cv::Mat1b();
    for (Claim& claim : claims) {
      frame.T_robot_camera = claim.mounting(i);
      claim.segmenter.segment(frame, claim.result);
      EXPECT_TRUE(claim.result.floor.trusted) << i;
      if (has_mask) add(claim.result.labels, mask, claim.counts);
    }
  }
}

TEST(RecordedFrames, FloorIsFoundWhateverHeightIsClaimed) {
  ROOMWISE_NEED_DATA(kRecording);
  std::vector<Claim> claims;
  for (const double claimed_height_m : {0.3, 1.2, 1.9}) claims.emplace_back(claimed_height_m);
  score(claims);
  for (const Claim& claim : claims) {
    const FloorCounts& counts = claim.counts;
    const double wrong_ratio = counts.wrong / (counts.wrong + counts.other);
    std::printf(
        "claimed %.1f m: floor IoU %.4f, other called floor %.4f, floor called standing %.4f\n",
        claim.height_m, counts.iou(), wrong_ratio,
        counts.missed_as_standing / (counts.right + counts.missed));
    // The masks call everything within 3 cm of one plane floor, the feet of cupboards and chairs
    // too; what is called standing there is counted as missed.
    EXPECT_GE(counts.iou(), 0.95) << claim.height_m;
    EXPECT_GE((counts.right + counts.missed_as_standing) / (counts.right + counts.missed), 0.99)
        << claim.height_m;
    EXPECT_LE(wrong_ratio, 0.002) << claim.height_m;
  }
}

}  // namespace
}  // namespace roomwise::segment
