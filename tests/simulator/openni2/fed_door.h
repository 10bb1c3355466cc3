#pragma once
#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>

#include "services/simulator/device/frame_door.h"
#include "tests/kinect_pub/support/made_frames.h"

namespace roomwise::simulator {

/// A frame door that a thread feeds with made frames, as asked for, until it goes.
class FedDoor {
 public:
  explicit FedDoor(const std::filesystem::path& path)
      : door_(path, {.serial = "fed-7"}), feeder_([this] { feed(); }) {}
  FedDoor(const FedDoor&) = delete;
  FedDoor& operator=(const FedDoor&) = delete;
  ~FedDoor() {
    stopping_ = true;
    feeder_.join();
  }
  FrameRequest request() const { return door_.request(); }

 private:
  void feed() {
    for (std::int64_t number = 0; !stopping_; ++number) {
      door_.write(made_frame(number, door_.request()), made_device_time_us(number));
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }

  FrameDoor door_;
  std::atomic<bool> stopping_{false};
  std::thread feeder_;
};

}  // namespace roomwise::simulator
