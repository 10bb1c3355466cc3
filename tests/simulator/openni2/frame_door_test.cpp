#include "services/simulator/device/frame_door.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <memory>
#include <thread>

#include "services/simulator/device/frame_door_reader.h"
#include "tests/kinect_pub/support/made_frames.h"
#include "tests/support/build_paths.h"
#include "tests/support/child_process.h"
#include "tests/support/scratch_folder.h"

namespace roomwise::simulator {
namespace {

using Wait = FrameDoorReader::Wait;
using std::chrono::milliseconds;

class FrameDoorTest : public ::testing::Test {
 protected:
  std::string opening_fails_with() {
    try {
      FrameDoorReader reader(path_);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  ScratchFolder folder_;
  const std::filesystem::path path_ = folder_.path() / "run" / "kinect";
  DoorFrame frame_;
};

void expect_equal(const DoorFrame& frame, const RgbdFrame& written) {
  EXPECT_EQ(frame.depth_mm, written.depth.steps);
  EXPECT_EQ(frame.rgb, written.color.rgb);
  EXPECT_EQ(frame.depth_width_px, written.depth.width_px);
  EXPECT_EQ(frame.color_height_px, written.color.height_px);
  EXPECT_EQ(frame.depth_registered, written.depth_registered);
}

TEST_F(FrameDoorTest, FramesComeThroughBitForBit) {
  FrameDoor door(path_, {});
  FrameDoorReader reader(path_);
  for (const FrameRequest& request :
       {FrameRequest{}, FrameRequest{320, 320, true}, FrameRequest{320, 640, false}}) {
    const RgbdFrame written = made_frame(3, request);
    door.write(written, 12345);
    ASSERT_EQ(reader.next(frame_, milliseconds(0)), Wait::kFrame);
    expect_equal(frame_, written);
    EXPECT_EQ(frame_.device_time_us, 12345);
  }
}

TEST_F(FrameDoorTest, DescriptionAndRequestsComeThrough) {
  FrameDoor door(path_, {.serial = "abc", .depth_camera = {1.0, 2.0, 3.0, 4.0}});
  FrameDoorReader reader(path_);
  EXPECT_EQ(reader.serial(), "abc");
  EXPECT_EQ(reader.depth_camera().cy_px, 4.0);
  EXPECT_EQ(door.request(), FrameRequest{});
  reader.ask({320, 640, true});
  EXPECT_EQ(door.request(), (FrameRequest{320, 640, true}));
}

TEST_F(FrameDoorTest, ReaderThatKeepsUpGetsEveryFrameInOrder) {
  FrameDoor door(path_, {});
  FrameDoorReader reader(path_);
  const RgbdFrame written = made_frame(0, {320, 320, false});
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i < 3; ++i) door.write(written, 0);
    for (int i = 1; i <= 3; ++i) {
      ASSERT_EQ(reader.next(frame_, milliseconds(0)), Wait::kFrame);
      EXPECT_EQ(frame_.number, 3 * round + i);
    }
  }
  EXPECT_EQ(reader.next(frame_, milliseconds(0)), Wait::kNothing);
  EXPECT_EQ(reader.missed(), 0);
}

TEST_F(FrameDoorTest, ReaderThatFallsBehindMissesTheOldestAndCountsThem) {
  FrameDoor door(path_, {});
  FrameDoorReader reader(path_);
  const RgbdFrame written = made_frame(0, {320, 320, false});
  for (int i = 0; i < 10; ++i) door.write(written, 0);
  std::vector<std::int64_t> numbers;
  while (reader.next(frame_, milliseconds(0)) == Wait::kFrame) numbers.push_back(frame_.number);
  EXPECT_THAT(numbers, ::testing::ElementsAre(8, 9, 10));
  EXPECT_EQ(reader.missed(), 7);
}

TEST_F(FrameDoorTest, FramesBeforeTheReaderCameAreNotHandedOut) {
  FrameDoor door(path_, {});
  door.write(made_frame(0), 0);
  FrameDoorReader reader(path_);
  EXPECT_EQ(reader.next(frame_, milliseconds(0)), Wait::kNothing);
}

/// A frame whose every pixel says its number.
RgbdFrame plain_frame(std::uint16_t number) {
  RgbdFrame frame = made_frame(0, {640, 640, false});
  std::ranges::fill(frame.depth.steps, number);
  std::ranges::fill(frame.color.rgb, static_cast<std::uint8_t>(number));
  return frame;
}

TEST_F(FrameDoorTest, FramesAreWholeHoweverFastTheWriterIs) {
  FrameDoor door(path_, {});
  FrameDoorReader reader(path_);
  std::vector<RgbdFrame> written;
  for (std::uint16_t i = 0; i < 16; ++i) written.push_back(plain_frame(i));
  std::atomic<bool> stop{false};
  std::thread writer([&] {
    for (std::int64_t i = 0; !stop; ++i) door.write(written[static_cast<std::size_t>(i % 16)], i);
  });
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(reader.next(frame_, milliseconds(5000)), Wait::kFrame);
    const RgbdFrame& expected = written[static_cast<std::size_t>(frame_.device_time_us % 16)];
    ASSERT_EQ(frame_.depth_mm, expected.depth.steps);
    ASSERT_EQ(frame_.rgb, expected.color.rgb);
  }
  stop = true;
  writer.join();
}

TEST_F(FrameDoorTest, ReaderSeesAClosedDoorAndTheNextOneIsAnother) {
  auto door = std::make_unique<FrameDoor>(path_, FrameDoorDescription{});
  FrameDoorReader reader(path_);
  EXPECT_TRUE(reader.is_served());
  door.reset();
  EXPECT_EQ(reader.next(frame_, milliseconds(5000)), Wait::kGone);
  EXPECT_FALSE(std::filesystem::exists(path_));

  FrameDoor again(path_, {});
  again.write(made_frame(0), 0);
  EXPECT_EQ(reader.next(frame_, milliseconds(0)), Wait::kGone);
  EXPECT_TRUE(FrameDoorReader(path_).is_served());
}

TEST_F(FrameDoorTest, KilledWriterIsSeenGoneAndReplaced) {
  ChildProcess camera({test_program("made_camera"), path_}, folder_.path() / "said");
  while (!std::filesystem::exists(path_)) std::this_thread::sleep_for(milliseconds(5));
  FrameDoorReader reader(path_);
  ASSERT_EQ(reader.next(frame_, milliseconds(10'000)), Wait::kFrame);
  EXPECT_THROW(FrameDoor(path_, {}), std::runtime_error) << "two served one door";
  camera.send_signal(SIGKILL);
  camera.wait();
  while (reader.next(frame_, milliseconds(5000)) == Wait::kFrame) {
  }
  EXPECT_FALSE(reader.is_served());
  EXPECT_THAT(opening_fails_with(), ::testing::HasSubstr("nobody serves it"));
  const FrameDoor door(path_, {});
  EXPECT_EQ(opening_fails_with(), "");
}

TEST_F(FrameDoorTest, ReadersMayComeAndGo) {
  FrameDoor door(path_, {});
  for (int i = 0; i < 5; ++i) {
    FrameDoorReader first(path_);
    FrameDoorReader second(path_);
    door.write(made_frame(i), i);
    EXPECT_EQ(first.next(frame_, milliseconds(0)), Wait::kFrame);
    EXPECT_EQ(second.next(frame_, milliseconds(0)), Wait::kFrame);
  }
  EXPECT_TRUE(FrameDoorReader(path_).is_served());
}

TEST_F(FrameDoorTest, WhatIsNoDoorIsRefusedByName) {
  EXPECT_THAT(opening_fails_with(), ::testing::HasSubstr("kinect: No such file"));
  std::filesystem::create_directories(path_.parent_path());
  std::ofstream(path_) << "something else";
  EXPECT_THAT(opening_fails_with(), ::testing::HasSubstr("is no frame door"));
}

TEST_F(FrameDoorTest, ImagesOfOtherSizesAreRefused) {
  FrameDoor door(path_, {});
  RgbdFrame frame = made_frame(0);
  frame.depth.width_px = 639;
  EXPECT_THROW(door.write(frame, 0), std::invalid_argument);
  frame = made_frame(0);
  frame.color.rgb.pop_back();
  EXPECT_THROW(door.write(frame, 0), std::invalid_argument);
}

}  // namespace
}  // namespace roomwise::simulator
