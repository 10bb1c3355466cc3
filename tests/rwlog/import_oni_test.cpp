// rwlog import oni: a camera made behind libRoomwiseSim, OpenNI2's own recorder, and rwlog.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <thread>
#include <vector>

#include "common/bus/log_file.h"
#include "common/channels.h"
#include "common/frames/frame_decoder.h"
#include "tests/kinect_pub/support/kinect_run.h"
#include "tests/kinect_pub/support/made_frames.h"
#include "tests/support/build_paths.h"

namespace roomwise {
namespace {

class ImportOni : public ::testing::Test {
 protected:
  void record(int images) {
    run_.start_camera();
    while (!std::filesystem::exists(run_.folder() / "kinect")) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_EQ(
        run_to_end({test_program("record_oni"), run_.camera_uri(), oni_, std::to_string(images)},
                   said_),
        0)
        << said_;
    run_.kill_camera();
  }

  int import(const std::string& out) {
    return run_to_end({program("rwlog"), "import", "oni", oni_, "-o", out}, said_);
  }

  static std::vector<kinect_frame_t> frames_in(const std::filesystem::path& log) {
    std::vector<kinect_frame_t> frames;
    LogReader reader(log);
    LogEvent event;
    while (reader.next(event)) {
      EXPECT_EQ(event.channel, channels::kKinectFrame.name);
      kinect_frame_t& frame = frames.emplace_back();
      EXPECT_EQ(decode(event.data, frame), DecodeResult::kOk);
    }
    return frames;
  }

  KinectRun run_;
  const std::string oni_ = run_.folder() / "made.oni";
  const std::string log_ = run_.folder() / "out.lcmlog";
  std::string said_;
};

TEST_F(ImportOni, EveryPairOfTheRecordingIsThereOnceAndInOrder) {
  record(40);
  ASSERT_EQ(import(log_), 0) << said_;
  const auto frames = frames_in(log_);
  // The recorder starts and stops its streams one after the other.
  EXPECT_GE(frames.size(), 38U) << said_;
  FrameDecoder decoder(ColorUse::kDecode);
  RgbdFrame frame;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const kinect_frame_t& message = frames[i];
    ASSERT_EQ(decoder.decode(message, frame), FrameResult::kOk);
    EXPECT_EQ(message.seq, static_cast<std::int64_t>(i) + 1);
    EXPECT_NEAR(frame.depth_camera.fx_px, 575.8, 1e-3);
    EXPECT_NEAR(frame.color_camera.fx_px, 525.0, 1e-3);
    EXPECT_EQ(frame.color.width_px, 640);
    EXPECT_TRUE(i == 0 || message.utime > frames[i - 1].utime);
  }
}

TEST_F(ImportOni, DepthIsThatOfTheCameraPixelByPixel) {
  record(20);
  ASSERT_EQ(import(log_), 0) << said_;
  std::vector<std::vector<std::uint16_t>> made;
  for (int i = 0; i < kMadeFrames; ++i) made.push_back(made_frame(i).depth.steps);
  FrameDecoder decoder(ColorUse::kSkip);
  RgbdFrame frame;
  for (const kinect_frame_t& message : frames_in(log_)) {
    ASSERT_EQ(decoder.decode(message, frame), FrameResult::kOk);
    EXPECT_THAT(made, ::testing::Contains(frame.depth.steps)) << message.seq;
  }
}

TEST_F(ImportOni, SameRecordingGivesTheSameBytes) {
  record(10);
  ASSERT_EQ(import(log_), 0) << said_;
  ASSERT_EQ(import(log_ + "2"), 0) << said_;
  const auto bytes = [](const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_GT(bytes(log_).size(), 10'000U);
  EXPECT_TRUE(bytes(log_) == bytes(log_ + "2"));
}

TEST_F(ImportOni, RegisteredDepthHasTheColourCamera) {
  record(10);
  ASSERT_EQ(
      run_to_end({program("rwlog"), "import", "oni", oni_, "-o", log_, "--registered"}, said_), 0)
      << said_;
  const kinect_frame_t frame = frames_in(log_).at(0);
  EXPECT_EQ(frame.depth_registered, 1);
  EXPECT_NEAR(frame.depth_fx_px, 525.0, 1e-3);
}

TEST_F(ImportOni, ServiceReplaysTheLog) {
  record(20);
  ASSERT_EQ(import(log_), 0) << said_;
  const std::string replayed = run_.folder() / "replayed.lcmlog";
  ASSERT_EQ(run_to_end({program("landmark_svc"), "--replay", log_, "--record", replayed}, said_), 0)
      << said_;
  LogReader reader(replayed);
  LogEvent event;
  std::size_t answers = 0;
  while (reader.next(event)) answers += event.channel == channels::kLandmarks.name ? 1 : 0;
  EXPECT_EQ(answers, frames_in(log_).size());
}

TEST_F(ImportOni, WhatIsNoRecordingIsRefusedByNameAndNothingIsWritten) {
  std::ofstream(oni_) << "no recording at all";
  EXPECT_EQ(import(log_), 1);
  EXPECT_THAT(said_, ::testing::HasSubstr("rwlog: " + oni_ + ": cannot be played"));
  std::filesystem::remove(oni_);
  EXPECT_EQ(import(log_), 1);
  EXPECT_THAT(said_, ::testing::HasSubstr("rwlog: " + oni_ + ": no such recording"));
  EXPECT_FALSE(std::filesystem::exists(log_));
}

TEST_F(ImportOni, CutRecordingIsRefusedByNameAndTheOldLogStays) {
  record(20);
  std::ofstream(log_) << "the old one";
  // The recorder makes room for twice what it writes.
  std::filesystem::resize_file(oni_, std::filesystem::file_size(oni_) / 4);
  EXPECT_EQ(import(log_), 1) << said_;
  EXPECT_THAT(said_, ::testing::HasSubstr("rwlog: " + oni_ + ": "));
  EXPECT_EQ(std::filesystem::file_size(log_), 11U);
}

}  // namespace
}  // namespace roomwise
