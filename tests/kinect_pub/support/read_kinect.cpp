// read_kinect URI FILE IMAGES: writes the disparity words of a Kinect's depth images one after the
// other, and says what its motor and accelerometer say.
#include <OpenNI.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "services/kinect_pub/freenect/freenect_properties.h"

namespace {

constexpr auto kOk = openni::STATUS_OK;

bool choose_words(openni::VideoStream& depth) {
  openni::VideoMode mode;
  mode.setPixelFormat(openni::PIXEL_FORMAT_SHIFT_9_2);
  mode.setResolution(640, 480);
  mode.setFps(30);
  return depth.setVideoMode(mode) == kOk;
}

bool say_posture(openni::Device& device) {
  double tilt_rad = 0.0;
  std::array<double, 3> acceleration_mps2{};
  int tilt_size = sizeof tilt_rad;
  int acceleration_size = sizeof acceleration_mps2;
  if (device.getProperty(roomwise::kFreenectTilt_rad, &tilt_rad, &tilt_size) != kOk) return false;
  if (device.getProperty(roomwise::kFreenectAcceleration_mps2, acceleration_mps2.data(),
                         &acceleration_size) != kOk) {
    return false;
  }
  std::printf("%.3f %.3f %.3f %.3f\n", tilt_rad, acceleration_mps2[0], acceleration_mps2[1],
              acceleration_mps2[2]);
  return true;
}

bool read(const char* uri, const char* file, int images) {
  openni::Device device;
  openni::VideoStream depth;
  if (device.open(uri) != kOk || depth.create(device, openni::SENSOR_DEPTH) != kOk ||
      !choose_words(depth) || depth.start() != kOk) {
    return false;
  }
  std::ofstream out(file, std::ios::binary);
  openni::VideoFrameRef image;
  for (int i = 0; i < images; ++i) {
    if (depth.readFrame(&image) != kOk) return false;
    out.write(static_cast<const char*>(image.getData()), image.getDataSize());
  }
  image.release();
  const bool said = say_posture(device);
  depth.destroy();
  device.close();
  return said;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4 || openni::OpenNI::initialize() != kOk) return 2;
  if (read(argv[1], argv[2], std::atoi(argv[3]))) return 0;
  std::fprintf(stderr, "read_kinect: %s\n", openni::OpenNI::getExtendedError());
  return 1;
}
