#pragma once
#include <OpenNI.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "tests/kinect_pub/support/made_frames.h"
#include "tests/support/scratch_folder.h"

namespace roomwise::simulator {

inline std::string uri_of(const std::filesystem::path& door) {
  return "roomwise-sim://" + door.string();
}

/// Where the driver looks for a camera to list: the same for the life of the process.
inline std::filesystem::path default_door() {
  static const ScratchFolder folder;
  return folder.path() / "kinect";
}

/// Starts OpenNI2 for the life of the process. It is never shut down: it would deadlock if a door
/// went at that moment.
inline void start_openni() {
  ::setenv("ROOMWISE_SIM_KINECT", default_door().c_str(), 1);
  static const openni::Status status = openni::OpenNI::initialize();
  ASSERT_EQ(status, openni::STATUS_OK) << openni::OpenNI::getExtendedError();
}

/// A device with both streams, as a client of OpenNI2 sees it. Streams go before their device.
struct OpenedCamera {
  explicit OpenedCamera(const std::string& uri) {
    // The driver may be busy telling OpenNI2 of another device.
    for (int i = 0; i < 50 && device.open(uri.c_str()) != openni::STATUS_OK; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_TRUE(device.isValid()) << openni::OpenNI::getExtendedError();
    EXPECT_EQ(depth.create(device, openni::SENSOR_DEPTH), openni::STATUS_OK);
    EXPECT_EQ(color.create(device, openni::SENSOR_COLOR), openni::STATUS_OK);
  }
  OpenedCamera(const OpenedCamera&) = delete;
  OpenedCamera& operator=(const OpenedCamera&) = delete;
  ~OpenedCamera() {
    depth.destroy();
    color.destroy();
    device.close();
  }
  void start() {
    EXPECT_EQ(depth.start(), openni::STATUS_OK);
    EXPECT_EQ(color.start(), openni::STATUS_OK);
  }
  void mirror(bool on) {
    EXPECT_EQ(depth.setMirroringEnabled(on), openni::STATUS_OK);
    EXPECT_EQ(color.setMirroringEnabled(on), openni::STATUS_OK);
  }
  openni::Device device;
  openni::VideoStream depth;
  openni::VideoStream color;
};

/// The next image of `stream`; invalid if none comes within `patience_ms`.
inline openni::VideoFrameRef next_image(openni::VideoStream& stream, int patience_ms = 5000) {
  openni::VideoStream* streams[] = {&stream};
  int ready = 0;
  openni::VideoFrameRef image;
  if (openni::OpenNI::waitForAnyStream(streams, 1, &ready, patience_ms) == openni::STATUS_OK) {
    stream.readFrame(&image);
  }
  return image;
}

/// Pixels of an image without gaps.
template <class Pixel>
std::vector<Pixel> pixels_of(const openni::VideoFrameRef& image) {
  const auto* pixels = static_cast<const Pixel*>(image.getData());
  return {pixels, pixels + image.getDataSize() / static_cast<int>(sizeof(Pixel))};
}

}  // namespace roomwise::simulator
