#include "logs/tools/import_7scenes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "common/frames/frame_decoder.h"
#include "logs/tools/camera_pose.h"
#include "logs/tools/image_file.h"
#include "tests/rwlog/images.h"
#include "tests/rwlog/log_messages.h"
#include "tests/rwlog/written_files.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/shared_data.h"

namespace roomwise {
namespace {

using testing::HasSubstr;

constexpr std::int64_t kFirst_utime = 1'356'998'400'000'000;  // 2013-01-01

/// Frames 0 and 2 of a camera that looks along the set's z; its world's y points down.
class Import7Scenes : public testing::Test {
 protected:
  Import7Scenes() {
    for (const char* stem : {"frame-000000", "frame-000002"}) {
      write_image(folder_ / (std::string(stem) + ".color.jpg"), made_color());
      write_image(folder_ / (std::string(stem) + ".depth.png"), made_depth());
    }
    write_text(folder_ / "frame-000000.pose.txt", "1 0 0 5\n0 1 0 6\n0 0 1 7\n0 0 0 1\n");
    write_text(folder_ / "frame-000002.pose.txt", "1 0 0 5.5\n0 1 0 5.9\n0 0 1 8\n0 0 0 1\n");
    write_text(folder_ / "camera-intrinsics.txt", "30 0 16\n0 31 12\n0 0 1\n");
  }

  std::string import(double camera_height_m = 1.0) {
    std::ostringstream notes;
    import_7scenes({folder_, out_, camera_height_m}, notes);
    return notes.str();
  }

  std::vector<RgbdFrame> frames() const {
    FrameDecoder decoder(ColorUse::kDecode);
    std::vector<RgbdFrame> all;
    for (const auto& message : messages_on(out_, channels::kKinectFrame)) {
      EXPECT_EQ(decoder.decode(message, all.emplace_back()), FrameResult::kOk);
    }
    return all;
  }

  ScratchFolder scratch_;
  std::filesystem::path folder_ = scratch_.path() / "seq";
  std::filesystem::path out_ = scratch_.path() / "out.lcmlog";
};

TEST_F(Import7Scenes, FrameNumbersGiveTimesAndSequence) {
  EXPECT_THAT(import(), HasSubstr("assumed: 30 Hz from 2013-01-01 00:00 UTC"));
  const auto messages = messages_on(out_, channels::kKinectFrame);
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(messages[0].utime, kFirst_utime);
  EXPECT_EQ(messages[0].seq, 1);
  EXPECT_EQ(messages[1].utime, kFirst_utime + 66'666);
  EXPECT_EQ(messages[1].seq, 3);
}

TEST_F(Import7Scenes, ColourIsPassedThroughAndDepthKeepsItsMillimetres) {
  import();
  const auto message = messages_on(out_, channels::kKinectFrame)[0];
  const std::string jpeg = read_text(folder_ / "frame-000000.color.jpg");
  EXPECT_TRUE(std::ranges::equal(message.color_data, jpeg, {}, {},
                                 [](char c) { return static_cast<std::uint8_t>(c); }));
  const RgbdFrame frame = frames()[0];
  cv::Mat1w expected = made_depth();
  expected(kMadeHeight_px - 1, kMadeWidth_px - 1) = 0;  // 65535 is no reading either
  EXPECT_TRUE(std::ranges::equal(frame.depth.steps, expected));
  EXPECT_DOUBLE_EQ(frame.depth.unit_m, 0.001);
  EXPECT_DOUBLE_EQ(frame.depth_camera.fx_px, 30.0);
  EXPECT_DOUBLE_EQ(frame.depth_camera.cy_px, 12.0);
}

TEST_F(Import7Scenes, TheWorldIsTheFloorBelowTheFirstCamera) {
  write_text(folder_ / "gravity-direction.txt", "0\n2\n0\n");
  import(0.8);
  const auto truth = messages_on(out_, channels::kTruth);
  ASSERT_EQ(truth.size(), 2U);
  EXPECT_NEAR(truth[0].true_x_m, 0.0, 1e-9);
  EXPECT_NEAR(truth[0].true_y_m, 0.0, 1e-9);
  EXPECT_NEAR(truth[0].true_heading_rad, 0.0, 1e-9);
  EXPECT_NEAR(truth[0].T_world_camera_translation_m[2], 0.8, 1e-9);
  // 1 m ahead, 0.5 m to the right, 0.1 m up.
  EXPECT_NEAR(truth[1].true_x_m, 1.0, 1e-9);
  EXPECT_NEAR(truth[1].true_y_m, -0.5, 1e-9);
  EXPECT_NEAR(truth[1].T_world_camera_translation_m[2], 0.9, 1e-9);
  EXPECT_TRUE(frames()[1].T_robot_camera.isApprox(level_mounting(0.9), 1e-9));
}

TEST_F(Import7Scenes, GravityGivesTheTilt) {
  // Down lies between the image's down and the optical axis: the camera looks 45 degrees down.
  write_text(folder_ / "gravity-direction.txt", "0 1 1\n");
  import();
  const Eigen::Vector3d axis = frames()[0].T_robot_camera.linear().col(2);
  EXPECT_NEAR(axis.x(), std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(axis.y(), 0.0, 1e-9);
  EXPECT_NEAR(axis.z(), -std::sqrt(0.5), 1e-9);
}

TEST_F(Import7Scenes, WithoutGravityOrPosesTheCameraIsLevel) {
  EXPECT_THAT(import(), HasSubstr("assumed: no gravity-direction.txt: level camera"));
  EXPECT_TRUE(frames()[0].T_robot_camera.isApprox(level_mounting(1.0), 1e-9));
  std::filesystem::remove(folder_ / "frame-000000.pose.txt");
  std::filesystem::remove(folder_ / "frame-000002.pose.txt");
  EXPECT_THAT(import(), HasSubstr("no pose files: level camera, no TRUTH"));
  EXPECT_TRUE(messages_on(out_, channels::kTruth).empty());
  EXPECT_TRUE(frames()[1].T_robot_camera.isApprox(level_mounting(1.0), 1e-9));
}

TEST_F(Import7Scenes, PngColourIsMadeJpegAndMissingIntrinsicsAreSaidAloud) {
  std::filesystem::remove(folder_ / "frame-000000.color.jpg");
  write_image(folder_ / "frame-000000.color.png", made_color());
  std::filesystem::remove(folder_ / "camera-intrinsics.txt");
  EXPECT_THAT(import(), HasSubstr("assumed: no camera-intrinsics.txt: fx = fy = 585 px"));
  EXPECT_EQ(frames()[0].color.width_px, kMadeWidth_px);
}

TEST_F(Import7Scenes, TwiceGivesTheSameBytes) {
  import();
  const std::string first = read_text(out_);
  import();
  EXPECT_EQ(read_text(out_), first);
}

TEST_F(Import7Scenes, ComplaintsNameTheFileAndLeaveNothing) {
  write_text(folder_ / "frame-000002.pose.txt", "1 0 0 5\n0 1 0 x\n0 0 1 7\n0 0 0 1\n");
  EXPECT_THAT(complaint_of([&] { import(); }), HasSubstr("frame-000002.pose.txt:2: "));
  write_text(folder_ / "frame-000002.pose.txt", "1 0 0 5\n0 1 0 6\n0 0 7 7\n0 0 0 1\n");
  EXPECT_THAT(complaint_of([&] { import(); }), HasSubstr("frame-000002.pose.txt: not a rotation"));
  std::filesystem::remove(folder_ / "frame-000002.pose.txt");
  std::filesystem::resize_file(folder_ / "frame-000002.color.jpg", 500);
  EXPECT_THAT(complaint_of([&] { import(); }), HasSubstr("frame-000002"));
  std::filesystem::remove(folder_ / "frame-000002.color.jpg");
  EXPECT_THAT(complaint_of([&] { import(); }), HasSubstr("frame-000002.color.jpg: cannot read"));
  std::filesystem::remove_all(folder_);
  EXPECT_THAT(complaint_of([&] { import(); }), HasSubstr("seq: not a folder"));
  EXPECT_FALSE(std::filesystem::exists(out_));
}

/// Heights above the floor of the pixels a mask calls floor, by the frame's own mounting. [m]
std::vector<double> floor_heights_m(const RgbdFrame& frame, const cv::Mat1b& mask) {
  std::vector<double> heights_m;
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      const double z_m = frame.depth.at(u, v) * frame.depth.unit_m;
      if (mask(v, u) != 255 || z_m <= 0.0) continue;
      const PinholeCamera& k = frame.depth_camera;
      const Eigen::Vector3d p_m((u - k.cx_px) / k.fx_px * z_m, (v - k.cy_px) / k.fy_px * z_m, z_m);
      heights_m.push_back((frame.T_robot_camera * p_m).z());
    }
  }
  std::ranges::sort(heights_m);
  return heights_m;
}

TEST_F(Import7Scenes, RealFloorIsLevel) {
  ROOMWISE_NEED_DATA("rgbd_7scenes_redkitchen_000_119");
  folder_ = shared_data() / "rgbd_7scenes_redkitchen_000_119";
  import(1.2);
  const auto all = frames();
  ASSERT_EQ(all.size(), 120U);
  double first_median_m = 0.0;
  for (const int number : {0, 60, 115}) {
    const auto mask = read_grey_png(
        folder_ / ("frame-" + std::to_string(1'000'000 + number).substr(1) + ".floor.png"));
    const auto heights_m = floor_heights_m(all[static_cast<std::size_t>(number)], mask);
    ASSERT_GT(heights_m.size(), 1000U);
    const double median_m = heights_m[heights_m.size() / 2];
    if (number == 0) first_median_m = median_m;
    // Gravity is 2 degrees off the floor's normal: 7 cm over 2 m.
    EXPECT_LT(heights_m[heights_m.size() * 9 / 10] - heights_m[heights_m.size() / 10], 0.12);
    EXPECT_NEAR(median_m, first_median_m, 0.1);
    RecordProperty("floor_median_mm_" + std::to_string(number), static_cast<int>(median_m * 1000));
  }
}

}  // namespace
}  // namespace roomwise
