#include "logs/tools/import_tum.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "common/frames/frame_decoder.h"
#include "logs/tools/camera_pose.h"
#include "tests/rwlog/images.h"
#include "tests/rwlog/log_messages.h"
#include "tests/rwlog/written_files.h"
#include "tests/support/scratch_folder.h"

namespace roomwise {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Three depth images, two of which have a colour image at nearly the same time.
class ImportTum : public testing::Test {
 protected:
  ImportTum() {
    write_text(folder_ / "rgb.txt", "# time file\n10.000 rgb/a.png\n10.051 rgb/b.png\n");
    write_text(folder_ / "depth.txt",
               "10.010000 depth/a.png\n10.035 depth/b.png\n10.500 depth/c.png\n");
    for (const char* name : {"a.png", "b.png", "c.png"}) {
      write_image(folder_ / "rgb" / name, made_color());
      write_image(folder_ / "depth" / name, made_depth());
    }
  }

  std::string import(TumImport options = {}) {
    options.folder = folder_;
    options.out = out_;
    std::ostringstream notes;
    import_tum(options, notes);
    return notes.str();
  }

  ScratchFolder scratch_;
  std::filesystem::path folder_ = scratch_.path() / "rgbd_dataset_freiburg2_desk";
  std::filesystem::path out_ = scratch_.path() / "out.lcmlog";
};

TEST_F(ImportTum, PairsByTimeAndCountsTheRest) {
  const std::string notes = import();
  const auto frames = messages_on(out_, channels::kKinectFrame);
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].utime, 10'010'000);
  EXPECT_EQ(frames[1].utime, 10'035'000);
  EXPECT_EQ(frames[1].seq, 2);
  EXPECT_THAT(notes, HasSubstr("frames 2; left out: 1 depth and 0 colour images"));
}

TEST_F(ImportTum, DepthStepsStayAsTheyAre) {
  import({.depth_scale = 2000.0});
  FrameDecoder decoder(ColorUse::kDecode);
  RgbdFrame frame;
  ASSERT_EQ(decoder.decode(messages_on(out_, channels::kKinectFrame)[0], frame), FrameResult::kOk);
  EXPECT_DOUBLE_EQ(frame.depth.unit_m, 0.0005);
  EXPECT_TRUE(std::ranges::equal(frame.depth.steps, made_depth()));
  EXPECT_TRUE(frame.depth_registered);
  EXPECT_EQ(frame.color.width_px, kMadeWidth_px);
}

TEST_F(ImportTum, IntrinsicsAreTheGivenOnesOrSaidAloud) {
  EXPECT_THAT(import(), HasSubstr("assumed: intrinsics of freiburg2: fx 520.9, fy 521"));
  EXPECT_DOUBLE_EQ(messages_on(out_, channels::kKinectFrame)[0].depth_fx_px, 520.9);
  const std::string notes = import({.camera = PinholeCamera{30, 31, 16, 12}});
  EXPECT_THAT(notes, testing::Not(HasSubstr("intrinsics")));
  EXPECT_DOUBLE_EQ(messages_on(out_, channels::kKinectFrame)[0].color_fy_px, 31.0);
}

TEST_F(ImportTum, WithoutTruthTheCameraIsLevel) {
  EXPECT_THAT(import({.camera_height_m = 0.9}), HasSubstr("assumed: level camera 0.9 m"));
  FrameDecoder decoder(ColorUse::kSkip);
  RgbdFrame frame;
  ASSERT_EQ(decoder.decode(messages_on(out_, channels::kKinectFrame)[0], frame), FrameResult::kOk);
  EXPECT_TRUE(frame.T_robot_camera.isApprox(level_mounting(0.9), 1e-12));
}

TEST_F(ImportTum, TruthGivesPosesAndTilt) {
  // Looks along world y from (1, 2, 1.5), level: camera z = y, x = x, y = -z.
  const std::string pose = " 1 2 1.5 -0.70710678 0 0 0.70710678\n";
  write_text(folder_ / "groundtruth.txt",
             "# comment\n9.9" + pose + "10.0101" + pose + "11.0" + pose);
  import();
  const auto truth = messages_on(out_, channels::kTruth);
  ASSERT_EQ(truth.size(), 3U);
  EXPECT_NEAR(truth[0].true_x_m, 1.0, 1e-9);
  EXPECT_NEAR(truth[0].true_y_m, 2.0, 1e-9);
  EXPECT_NEAR(truth[0].true_heading_rad, std::numbers::pi / 2, 1e-7);
  EXPECT_NEAR(truth[0].T_world_camera_translation_m[2], 1.5, 1e-12);
  EXPECT_THAT(channel_order(out_),
              ElementsAre("TRUTH", "KINECT_FRAME", "TRUTH", "KINECT_FRAME", "TRUTH"));
  FrameDecoder decoder(ColorUse::kSkip);
  RgbdFrame frame;
  ASSERT_EQ(decoder.decode(messages_on(out_, channels::kKinectFrame)[0], frame), FrameResult::kOk);
  EXPECT_TRUE(frame.T_robot_camera.isApprox(level_mounting(1.5), 1e-6));
}

TEST_F(ImportTum, TwiceGivesTheSameBytes) {
  import();
  const std::string first = read_text(out_);
  import();
  EXPECT_EQ(read_text(out_), first);
}

TEST_F(ImportTum, ComplaintsNameTheFileAndLeaveNothing) {
  write_text(folder_ / "depth" / "b.png", "not an image");
  EXPECT_THAT(complaint_of([&] { import(); }), HasSubstr("depth/b.png: not an image"));
  write_image(folder_ / "depth" / "b.png", made_color());
  EXPECT_THAT(complaint_of([&] { import(); }), HasSubstr("depth/b.png: must be a 16-bit grey"));
  std::filesystem::remove(folder_ / "rgb" / "a.png");
  EXPECT_THAT(complaint_of([&] { import(); }), HasSubstr("rgb/a.png: cannot read"));
  write_text(folder_ / "groundtruth.txt", "10 0 0 0 0 0 0 2\n");
  EXPECT_THAT(complaint_of([&] { import(); }), HasSubstr("groundtruth.txt:1: quaternion"));
  write_text(folder_ / "rgb.txt", "10 a.png\n9 b.png\n");
  EXPECT_THAT(complaint_of([&] { import(); }), HasSubstr("rgb.txt:2: time goes back"));
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(ImportTum, NoPairAtAllIsAnError) {
  write_text(folder_ / "rgb.txt", "50 rgb/a.png\n");
  EXPECT_THAT(complaint_of([&] { import(); }), HasSubstr("no depth image within 20 ms"));
}

}  // namespace
}  // namespace roomwise
