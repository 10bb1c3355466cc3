// What OpenNI2's own recorder makes of the simulated camera plays back as it was.
#include <gtest/gtest.h>

#include <map>

#include "tests/simulator/openni2/fed_door.h"
#include "tests/simulator/openni2/opened_camera.h"
#include "tests/support/scratch_folder.h"

namespace roomwise::simulator {
namespace {

class RecordingTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { start_openni(); }

  void record(int images) {
    OpenedCamera camera(uri_of(door_));
    camera.mirror(false);
    openni::Recorder recorder;
    ASSERT_EQ(recorder.create(oni_.c_str()), openni::STATUS_OK);
    ASSERT_EQ(recorder.attach(camera.depth), openni::STATUS_OK);
    ASSERT_EQ(recorder.attach(camera.color, false), openni::STATUS_OK);
    camera.start();
    ASSERT_EQ(recorder.start(), openni::STATUS_OK);
    for (int i = 0; i < images; ++i) ASSERT_TRUE(next_image(camera.depth).isValid());
    recorder.stop();
    recorder.destroy();
  }

  ScratchFolder folder_;
  const std::filesystem::path door_ = folder_.path() / "kinect";
  const FedDoor fed_{door_};
  const std::string oni_ = folder_.path() / "made.oni";
};

/// Number of the made frame whose depth image this is; -1 if it is none of the first `count`.
std::int64_t number_of(const std::vector<std::uint16_t>& depth, std::int64_t count) {
  static std::map<std::vector<std::uint16_t>, std::int64_t> known;
  for (std::int64_t i = static_cast<std::int64_t>(known.size()); i < count; ++i) {
    known[made_frame(i).depth.steps] = i;
  }
  const auto found = known.find(depth);
  return found == known.end() ? -1 : found->second;
}

TEST_F(RecordingTest, PlaysBackPixelExact) {
  record(12);
  // Never closed: OpenNI2's player may look at streams that it has just freed.
  static OpenedCamera& camera = *new OpenedCamera(oni_);
  camera.device.getPlaybackControl()->setSpeed(-1.0F);  // as fast as it is read
  camera.device.getPlaybackControl()->setRepeatEnabled(false);
  EXPECT_FALSE(camera.depth.getMirroringEnabled());
  camera.start();
  std::vector<std::int64_t> numbers;
  for (openni::VideoFrameRef depth; (depth = next_image(camera.depth, 500)).isValid();) {
    numbers.push_back(number_of(pixels_of<std::uint16_t>(depth), 200));
  }
  ASSERT_GE(numbers.size(), 8U);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    EXPECT_EQ(numbers[i], numbers[0] + static_cast<std::int64_t>(i));
  EXPECT_GE(numbers[0], 0);
}

}  // namespace
}  // namespace roomwise::simulator
