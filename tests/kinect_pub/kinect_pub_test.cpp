// kinect_pub as a process: a camera made behind libRoomwiseSim, OpenNI2, kinect_pub, KINECT_FRAME.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <map>
#include <thread>

#include "common/frames/frame_decoder.h"
#include "tests/kinect_pub/support/kinect_run.h"
#include "tests/kinect_pub/support/made_frames.h"
#include "tests/support/build_paths.h"
#include "tests/support/private_network.h"

namespace roomwise {
namespace {

RgbdFrame shown_at(std::int64_t device_time_us, const simulator::FrameRequest& request) {
  return made_frame(made_number(device_time_us) % kMadeFrames, request);
}

RgbdFrame decoded(const kinect_frame_t& message) {
  FrameDecoder decoder(ColorUse::kDecode);
  RgbdFrame frame;
  EXPECT_EQ(decoder.decode(message, frame), FrameResult::kOk);
  return frame;
}

std::int64_t lines_in(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

class KinectPubTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { enter_private_network(); }

  KinectRun run_;
};

struct Resolution {
  const char* name;
  int width_px;
  bool registered;
};

class KinectPubResolutionTest : public KinectPubTest,
                                public ::testing::WithParamInterface<Resolution> {};

TEST_P(KinectPubResolutionTest, DepthAndColourArriveAsTheyWereMade) {
  const auto [name, width_px, registered] = GetParam();
  run_.start_camera();
  run_.start_kinect_pub(std::string("resolution = '") + name + "'\ncolor_encoding = 'rgb8'\n" +
                        "register_depth = " + (registered ? "true" : "false"));
  const auto messages = run_.frames(10);
  ASSERT_EQ(messages.size(), 10U) << run_.kinect_pub().output();
  for (const kinect_frame_t& message : messages) {
    const RgbdFrame frame = decoded(message);
    const RgbdFrame made = shown_at(message.device_time_us, {width_px, width_px, registered});
    EXPECT_EQ(frame.depth.steps, made.depth.steps);
    EXPECT_EQ(frame.color.rgb, made.color.rgb);
    EXPECT_EQ(frame.depth_registered, registered);
    const double focal_px = (registered ? 525.0 : 575.8) * width_px / 640.0;
    EXPECT_NEAR(frame.depth_camera.fx_px, focal_px, 1e-3);
    EXPECT_NEAR(frame.color_camera.fy_px, 525.0 * width_px / 640.0, 1e-3);
    EXPECT_EQ(frame.color_camera.cx_px, width_px / 2.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Resolutions, KinectPubResolutionTest,
                         ::testing::Values(Resolution{"640x480", 640, true},
                                           Resolution{"320x240", 320, true},
                                           Resolution{"640x480", 640, false}),
                         [](const auto& instance) {
                           return std::string("Width") + std::to_string(instance.param.width_px) +
                                  (instance.param.registered ? "Registered" : "Unregistered");
                         });

TEST_F(KinectPubTest, LosesNoFrameAfterItself) {
  run_.start_camera();
  run_.start_kinect_pub("");
  const auto messages = run_.frames(90);
  ASSERT_EQ(messages.size(), 90U) << run_.kinect_pub().output();
  for (std::size_t i = 1; i < messages.size(); ++i) {
    ASSERT_EQ(messages[i].seq, messages[i - 1].seq + 1);
    ASSERT_GT(messages[i].utime, messages[i - 1].utime);
    ASSERT_GT(messages[i].device_time_us, messages[i - 1].device_time_us);
  }
}

TEST_F(KinectPubTest, StatusSaysWhatIsInForce) {
  run_.start_camera();
  run_.start_kinect_pub("resolution = '320x240'");
  const auto status = run_.status([](const device_status_t& s) { return s.frames_published > 30; });
  ASSERT_TRUE(status) << run_.kinect_pub().output();
  EXPECT_EQ(status->state, device_status_t::STATE_STREAMING);
  EXPECT_EQ(status->device_uri, run_.camera_uri());
  EXPECT_EQ(status->device_serial, "made-1");
  EXPECT_EQ(status->device_name, "Roomwise Simulated Kinect");
  EXPECT_THAT(status->backend, ::testing::StartsWith("openni2 2."));
  EXPECT_EQ(status->depth_width_px, 320);
  EXPECT_EQ(status->color_height_px, 240);
  EXPECT_EQ(status->registration_asked, 1);
  EXPECT_EQ(status->registration_in_force, 1);
  EXPECT_EQ(status->mirrored_by_device, 0);
  EXPECT_GT(status->encode_mean_s, 0.0);
  EXPECT_EQ(status->last_error, "");
}

TEST_F(KinectPubTest, CameraMountAndOwnIntrinsicsGoIntoEveryFrame) {
  run_.start_camera();
  run_.start_kinect_pub(
      "camera_x_m = 0.11\ncamera_height_m = 0.42\nuse_own_intrinsics = true\ndepth_fx_px = 600.5");
  const auto messages = run_.frames(1);
  ASSERT_EQ(messages.size(), 1U) << run_.kinect_pub().output();
  EXPECT_EQ(messages[0].T_robot_camera_translation_m[0], 0.11);
  EXPECT_EQ(messages[0].T_robot_camera_translation_m[2], 0.42);
  EXPECT_EQ(messages[0].depth_fx_px, 600.5);
}

TEST_F(KinectPubTest, CameraThatDiesIsMissedAndUsedAgainWhenItReturns) {
  run_.start_camera();
  run_.start_kinect_pub("");
  ASSERT_EQ(run_.frames(100).size(), 100U) << run_.kinect_pub().output();
  run_.kill_camera();
  const auto lost = run_.status_of_state(device_status_t::STATE_LOST);
  ASSERT_TRUE(lost) << run_.kinect_pub().output();
  EXPECT_EQ(lost->device_losses, 1);
  EXPECT_THAT(lost->last_error, ::testing::Not(::testing::IsEmpty()));
  run_.start_camera();
  const auto back = run_.status([](const device_status_t& s) { return s.reconnects == 1; });
  ASSERT_TRUE(back) << run_.kinect_pub().output();
  EXPECT_EQ(run_.frames(3).size(), 3U);
  EXPECT_EQ(back->clock_restarts, 1) << "the made camera's clock starts anew";
}

TEST_F(KinectPubTest, CameraThatRestartsAtOnceIsFoundAgain) {
  run_.start_camera();
  run_.start_kinect_pub("device = '" + run_.camera_uri() + "'");
  for (int round = 1; round <= 3; ++round) {
    ASSERT_EQ(run_.frames(3).size(), 3U) << run_.kinect_pub().output();
    run_.kill_camera();
    run_.start_camera();
    ASSERT_TRUE(run_.status([&](const device_status_t& s) { return s.reconnects == round; }))
        << run_.kinect_pub().output();
  }
}

TEST_F(KinectPubTest, WaitsForACameraThatComesLater) {
  run_.start_kinect_pub("device = '" + run_.camera_uri() + "'");
  const auto searching = run_.status_of_state(device_status_t::STATE_SEARCHING);
  ASSERT_TRUE(searching) << run_.kinect_pub().output();
  run_.start_camera();
  EXPECT_EQ(run_.frames(3).size(), 3U) << run_.kinect_pub().output();
}

TEST_F(KinectPubTest, KilledAndStartedAgainItGoesOnWithTheSameCamera) {
  run_.start_camera();
  for (int round = 0; round < 2; ++round) {
    run_.start_kinect_pub("");
    ASSERT_EQ(run_.frames(3).size(), 3U) << run_.kinect_pub().output();
    run_.kinect_pub().send_signal(SIGKILL);
    EXPECT_EQ(run_.kinect_pub().wait(), 128 + SIGKILL);
  }
}

TEST_F(KinectPubTest, MissingCameraIsSaidOnceAndWaitedFor) {
  run_.start_kinect_pub("");
  const auto status = run_.status(
      [](const device_status_t& s) { return s.last_error == "no camera is connected"; });
  ASSERT_TRUE(status) << run_.kinect_pub().output();
  EXPECT_EQ(status->state, device_status_t::STATE_SEARCHING);
  run_.status([n = 0](const device_status_t&) mutable { return ++n == 3; });
  const std::string said = run_.kinect_pub().output();
  EXPECT_THAT(said, ::testing::HasSubstr("kinect_pub: no camera is connected\n"));
  EXPECT_EQ(lines_in(said), 2) << said;
  run_.kinect_pub().send_signal(SIGTERM);
  EXPECT_EQ(run_.kinect_pub().wait(), 0);
}

TEST_F(KinectPubTest, StopsCleanlyWhileStreaming) {
  run_.start_camera();
  run_.start_kinect_pub("");
  ASSERT_EQ(run_.frames(3).size(), 3U) << run_.kinect_pub().output();
  run_.kinect_pub().send_signal(SIGINT);
  EXPECT_EQ(run_.kinect_pub().wait(), 0) << run_.kinect_pub().output();
}

TEST_F(KinectPubTest, StopsCleanlyThoughItsCameraGoesAtTheSameMoment) {
  for (int round = 0; round < 3; ++round) {
    run_.start_camera();
    run_.start_kinect_pub("");
    ASSERT_EQ(run_.frames(3).size(), 3U) << run_.kinect_pub().output();
    run_.kill_camera();
    run_.kinect_pub().send_signal(SIGTERM);
    EXPECT_EQ(run_.kinect_pub().wait(), 0) << run_.kinect_pub().output();
  }
}

class KinectPubRecordingTest : public KinectPubTest {
 protected:
  const std::string oni_ = run_.folder() / "made.oni";

  void record(int images) {
    run_.start_camera();
    while (!std::filesystem::exists(run_.folder() / "kinect")) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    std::string said;
    ASSERT_EQ(
        run_to_end({test_program("record_oni"), run_.camera_uri(), oni_, std::to_string(images)},
                   said),
        0)
        << said;
    run_.kill_camera();
  }
};

TEST_F(KinectPubRecordingTest, RecordingPlaysBackTheFramesItWasMadeFrom) {
  record(40);
  std::map<std::vector<std::uint16_t>, int> known;
  for (int i = 0; i < kMadeFrames; ++i) known[made_frame(i).depth.steps] = i;
  run_.start_kinect_pub("device = '" + oni_ + "'\nloop_recording = true");
  const auto messages = run_.frames(30);
  ASSERT_EQ(messages.size(), 30U) << run_.kinect_pub().output();
  for (const kinect_frame_t& message : messages) {
    EXPECT_TRUE(known.contains(decoded(message).depth.steps))
        << "frame at " << message.device_time_us << " us is none of those recorded";
    EXPECT_EQ(message.depth_registered, 0);
    EXPECT_NEAR(message.depth_fx_px, 575.8, 1e-3);
  }
}

TEST_F(KinectPubRecordingTest, EndOfARecordingIsSaidOnStatus) {
  record(20);
  run_.start_kinect_pub("device = '" + oni_ + "'");
  const auto status = run_.status_of_state(device_status_t::STATE_ENDED);
  ASSERT_TRUE(status) << run_.kinect_pub().output();
  EXPECT_GT(status->frames_published, 0);
  run_.kinect_pub().send_signal(SIGINT);
  EXPECT_EQ(run_.kinect_pub().wait(), 0) << run_.kinect_pub().output();
}

TEST_F(KinectPubRecordingTest, WhatIsNoRecordingIsRefusedInOneLine) {
  std::ofstream(oni_) << "no recording at all";
  run_.start_kinect_pub("device = '" + oni_ + "'");
  EXPECT_EQ(run_.kinect_pub().wait(), 1);
  EXPECT_THAT(run_.kinect_pub().output(), ::testing::HasSubstr("kinect_pub: " + oni_ + ": cannot"));
  EXPECT_EQ(lines_in(run_.kinect_pub().output()), 2) << run_.kinect_pub().output();

  run_.start_kinect_pub("device = '/nowhere/at/all.oni'");
  EXPECT_EQ(run_.kinect_pub().wait(), 1);
  EXPECT_THAT(run_.kinect_pub().output(),
              ::testing::HasSubstr("kinect_pub: /nowhere/at/all.oni: no such recording\n"));
}

TEST(KinectPubReplay, IsRefusedWithTheReason) {
  ScratchFolder folder;
  const std::string log = folder.path() / "in.lcmlog";
  std::ofstream(log).close();
  std::string said;
  EXPECT_EQ(run_to_end({program("kinect_pub"), "--replay", log}, said), 1);
  EXPECT_THAT(said, ::testing::HasSubstr("kinect_pub: has nothing to replay"));
}

}  // namespace
}  // namespace roomwise
