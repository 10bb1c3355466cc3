// The hardware doors together: simulator -> OpenNI2 -> kinect_pub, simulator -> pty ->
// create_driver.
#include "tests/system/hardware_chain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <thread>

#include "common/frames/frame_decoder.h"
#include "services/simulator/device/frame_door_reader.h"
#include "tests/support/private_network.h"

namespace roomwise {
namespace {

using Part = HardwareChain::Part;

/// What comes out of the simulated camera, read beside whoever else reads it, by device time.
class RenderedFrames {
 public:
  explicit RenderedFrames(const std::filesystem::path& door)
      : reader_(door), thread_([this] { read(); }) {}

  std::map<std::int64_t, simulator::DoorFrame> stop() {
    is_over_ = true;
    if (thread_.joinable()) thread_.join();
    return std::move(frames_);
  }
  ~RenderedFrames() { stop(); }

 private:
  void read() {
    simulator::DoorFrame frame;
    while (!is_over_) {
      if (reader_.next(frame, std::chrono::milliseconds(100)) ==
          simulator::FrameDoorReader::Wait::kFrame) {
        frames_[frame.device_time_us] = frame;
      }
    }
  }

  simulator::FrameDoorReader reader_;
  std::map<std::int64_t, simulator::DoorFrame> frames_;
  std::atomic<bool> is_over_{false};
  std::thread thread_;
};

class HardwareChainTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { enter_private_network(); }

  static bool is_driving(const HardwareChain& chain) {
    return !chain.states.empty() &&
           chain.states.back().driver_state == create_state_t::DRIVER_DRIVING;
  }
  static bool is_complete(const HardwareChain& chain) {
    return is_driving(chain) && chain.frames.size() > 3 && chain.truth.size() > 3;
  }
  static bool has_moved(const truth_t& a, const truth_t& b) {
    return std::hypot(a.true_x_m - b.true_x_m, a.true_y_m - b.true_y_m) > 1e-6 ||
           std::abs(a.true_heading_rad - b.true_heading_rad) > 1e-6;
  }
  static bool stands(const HardwareChain& chain) {
    const std::size_t count = chain.truth.size();
    return count > 5 && !has_moved(chain.truth[count - 5], chain.truth[count - 1]);
  }
};

TEST_F(HardwareChainTest, DepthAndColourArriveExactlyAsRendered) {
  HardwareChain chain("living_room", {"--color_encoding", "rgb8", "--register_depth", "true"});
  chain.start_all();
  ASSERT_TRUE(chain.listen_until([&] { return is_complete(chain); })) << chain.output();
  RenderedFrames rendered(chain.door());
  chain.forget();
  ASSERT_TRUE(chain.listen_until([&] { return chain.frames.size() > 30; })) << chain.output();
  const auto made = rendered.stop();

  FrameDecoder decoder(ColorUse::kDecode);
  RgbdFrame frame;
  int compared = 0;
  for (const kinect_frame_t& message : chain.frames) {
    const auto source = made.find(message.device_time_us);
    if (source == made.end()) continue;
    ASSERT_EQ(decoder.decode(message, frame), FrameResult::kOk);
    EXPECT_EQ(frame.depth.steps, source->second.depth_mm);
    EXPECT_EQ(frame.color.rgb, source->second.rgb);
    EXPECT_TRUE(frame.depth_registered);
    EXPECT_GT(std::count_if(frame.depth.steps.begin(), frame.depth.steps.end(),
                            [](std::uint16_t step) { return step != 0; }),
              100'000);
    ++compared;
  }
  EXPECT_GE(compared, 25);
}

// The order in which they die and come back must not matter.
TEST_F(HardwareChainTest, KilledInAnyOrderEverythingComesBackByItself) {
  HardwareChain chain("empty", {"--resolution", "320x240"});
  std::vector<Part> order = {Part::kSimulator, Part::kCreateDriver, Part::kKinectPub};
  chain.start_all();
  do {
    SCOPED_TRACE(std::to_string(order[0]) + std::to_string(order[1]) + std::to_string(order[2]));
    chain.forget();
    ASSERT_TRUE(chain.listen_until([&] { return is_complete(chain); })) << chain.output();
    for (const Part part : order) {
      chain.kill(part);
      chain.listen_for(std::chrono::milliseconds(200));
    }
    for (const Part part : order) {
      chain.start(part);
      chain.listen_for(std::chrono::milliseconds(200));
    }
  } while (std::next_permutation(order.begin(), order.end()));
  chain.forget();
  EXPECT_TRUE(chain.listen_until([&] { return is_complete(chain); })) << chain.output();
}

// One dies and is started again while the others live on.
TEST_F(HardwareChainTest, EachOneKilledIsTakenUpAgainByTheOthers) {
  HardwareChain chain("empty", {"--resolution", "320x240"});
  chain.start_all();
  for (const Part part : {Part::kCreateDriver, Part::kKinectPub, Part::kSimulator}) {
    chain.forget();
    ASSERT_TRUE(chain.listen_until([&] { return is_complete(chain); })) << chain.output();
    chain.kill(part);
    chain.forget();
    chain.listen_for(std::chrono::milliseconds(500));
    EXPECT_EQ(chain.states.empty(), part != Part::kKinectPub) << part;
    if (part == Part::kCreateDriver) {
      EXPECT_TRUE(stands(chain)) << "the guardian did not stop it";
    }
    chain.start(part);
  }
  chain.forget();
  EXPECT_TRUE(chain.listen_until([&] { return is_complete(chain); })) << chain.output();
}

}  // namespace
}  // namespace roomwise
