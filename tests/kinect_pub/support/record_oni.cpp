// record_oni URI FILE IMAGES: OpenNI2's own recorder on a device, until so many depth images came.
#include <OpenNI.h>

#include <cstdio>
#include <cstdlib>

namespace {

bool record(const char* uri, const char* file, int images) {
  openni::Device device;
  openni::VideoStream depth;
  openni::VideoStream color;
  openni::Recorder recorder;
  constexpr auto kOk = openni::STATUS_OK;
  if (device.open(uri) != kOk || depth.create(device, openni::SENSOR_DEPTH) != kOk ||
      color.create(device, openni::SENSOR_COLOR) != kOk || recorder.create(file) != kOk) {
    return false;
  }
  depth.setMirroringEnabled(false);
  color.setMirroringEnabled(false);
  recorder.attach(depth);
  recorder.attach(color);
  depth.start();
  color.start();
  recorder.start();
  openni::VideoFrameRef image;
  for (int i = 0; i < images; ++i) {
    if (depth.readFrame(&image) != kOk) return false;
  }
  image.release();
  recorder.stop();
  recorder.destroy();
  depth.destroy();
  color.destroy();
  device.close();
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4 || openni::OpenNI::initialize() != openni::STATUS_OK) return 2;
  if (record(argv[1], argv[2], std::atoi(argv[3]))) return 0;
  std::fprintf(stderr, "record_oni: %s\n", openni::OpenNI::getExtendedError());
  return 1;
}
