// made_camera DOOR: what a simulator is to kinect_pub, without a world: serves a frame door with
// made frames at 30 Hz until it is killed.
#include <chrono>
#include <cstdio>
#include <exception>
#include <thread>
#include <vector>

#include "services/simulator/device/frame_door.h"
#include "tests/kinect_pub/support/made_frames.h"

namespace roomwise {
namespace {

using std::chrono::steady_clock;

/// Frames are made ahead, so that the camera costs nothing while it runs.
class MadeFrames {
 public:
  const RgbdFrame& at(std::int64_t number, const simulator::FrameRequest& request) {
    if (frames_.empty() || !(request == request_)) {
      request_ = request;
      frames_.clear();
      for (int i = 0; i < kMadeFrames; ++i) frames_.push_back(made_frame(i, request));
    }
    return frames_[static_cast<std::size_t>(number) % frames_.size()];
  }

 private:
  simulator::FrameRequest request_;
  std::vector<RgbdFrame> frames_;
};

[[noreturn]] void serve(const char* path) {
  simulator::FrameDoor door(path, {.serial = "made-1"});
  MadeFrames frames;
  frames.at(0, door.request());
  auto due = steady_clock::now();
  for (std::int64_t number = 0;; ++number) {
    const RgbdFrame& frame = frames.at(number, door.request());
    door.write(frame, made_device_time_us(number));
    due = std::max(due + std::chrono::microseconds(33'333), steady_clock::now());
    std::this_thread::sleep_until(due);
  }
}

}  // namespace
}  // namespace roomwise

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  try {
    roomwise::serve(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "made_camera: %s\n", error.what());
    return 1;
  }
}
