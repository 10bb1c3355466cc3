#include "services/simulator/recording/recorded_drive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>

#include "common/bus/log_file.h"
#include "common/channels.h"
#include "common/frames/frame_decoder.h"
#include "tests/support/scratch_folder.h"

namespace roomwise::simulator {
namespace {

class RecordedDriveTest : public testing::Test {
 protected:
  RecordedDriveTest() {
    params_.scenario = "living_room";
    params_.camera_size = "320x240";
  }

  DriveSummary record(const std::string& name, double seconds, const std::string& path = "loop1") {
    return record_drive(params_, {.path = path, .seconds = seconds}, folder_.path() / name);
  }
  std::string bytes_of(const std::string& name) const {
    std::ostringstream bytes;
    bytes << std::ifstream(folder_.path() / name, std::ios::binary).rdbuf();
    return bytes.str();
  }
  template <class Message>
  std::vector<Message> messages(const std::string& name, const Channel<Message>& channel) const {
    LogReader log(folder_.path() / name);
    std::vector<Message> found;
    LogEvent event;
    while (log.next(event)) {
      Message message{};
      if (event.channel != channel.name) continue;
      EXPECT_EQ(decode(event.data, message), DecodeResult::kOk);
      found.push_back(std::move(message));
    }
    return found;
  }

  ScratchFolder folder_;
  SimulatorParams params_;
};

TEST_F(RecordedDriveTest, TheSameRequestGivesTheSameBytes) {
  record("a.lcmlog", 1.0);
  record("b.lcmlog", 1.0);
  EXPECT_EQ(bytes_of("a.lcmlog"), bytes_of("b.lcmlog"));
  params_.seed = 2;
  record("c.lcmlog", 1.0);
  EXPECT_NE(bytes_of("a.lcmlog"), bytes_of("c.lcmlog"));
}

TEST_F(RecordedDriveTest, HoldsWhatALiveSystemWouldHaveRecorded) {
  const DriveSummary summary = record("a.lcmlog", 2.0);
  EXPECT_EQ(summary.frames, 60);
  EXPECT_FALSE(summary.arrived);
  EXPECT_EQ(messages("a.lcmlog", channels::kKinectFrame).size(), 60u);
  EXPECT_EQ(messages("a.lcmlog", channels::kTruth).size(), 120u);
  const auto odometry = messages("a.lcmlog", channels::kOdometry);
  EXPECT_GT(odometry.size(), 100u);  // 66 Hz, less the time it takes to start the robot
  EXPECT_GT(odometry.back().x_m, 0.1);
  EXPECT_EQ(messages("a.lcmlog", channels::kCreateState).size(), odometry.size() + 1);
}

TEST_F(RecordedDriveTest, EveryFrameHasItsTrueLabelsIfAskedFor) {
  record("plain.lcmlog", 0.2);
  EXPECT_TRUE(messages("plain.lcmlog", channels::kTrueSegments).empty());
  params_.true_labels = true;
  record("labelled.lcmlog", 0.2);
  const auto frames = messages("labelled.lcmlog", channels::kKinectFrame);
  const auto labels = messages("labelled.lcmlog", channels::kTrueSegments);
  ASSERT_EQ(frames.size(), labels.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    EXPECT_EQ(labels[i].frame_seq, frames[i].seq);
    EXPECT_EQ(labels[i].utime, frames[i].utime);
    EXPECT_EQ(labels[i].label_width_px, frames[i].depth_width_px);
  }
}

TEST_F(RecordedDriveTest, TheServicesCanDecodeItsFrames) {
  record("a.lcmlog", 0.2);
  FrameDecoder decoder(ColorUse::kDecode);
  RgbdFrame frame;
  for (const kinect_frame_t& message : messages("a.lcmlog", channels::kKinectFrame)) {
    ASSERT_EQ(decoder.decode(message, frame), FrameResult::kOk);
    const auto seen = std::ranges::count_if(frame.depth.steps, [](auto step) { return step != 0; });
    EXPECT_GT(seen, static_cast<long>(frame.depth.size() / 2));
  }
}

TEST_F(RecordedDriveTest, ErrorsNameWhatIsWrongAndLeaveNoLog) {
  EXPECT_THAT([&] { record("a.lcmlog", 1.0, "loop9"); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr(
                  "scenario living_room has no path loop9; it has: loop1 loop2")));
  params_.scenario = "atlantis";
  EXPECT_THAT([&] { record("a.lcmlog", 1.0); },
              testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("atlantis")));
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

}  // namespace
}  // namespace roomwise::simulator
