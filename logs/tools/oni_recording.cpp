#include "logs/tools/oni_recording.h"

#include <OpenNI.h>

#include <algorithm>
#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "common/openni2/keep_open.h"
#include "common/openni2/openni_error.h"
#include "common/openni2/openni_images.h"
#include "services/kinect_pub/core/camera_geometry.h"

namespace roomwise {
namespace {

using openni::STATUS_OK;
using Image = openni::VideoFrameRef;
using Pairing = kinect::FramePairing<Image, Image>;

constexpr std::int64_t kPairTolerance_us = 17'000;  // half a frame
constexpr int kPatience_ms = 5'000;                 // for an image that is read from a file
/// Device clocks beyond this are nonsense (3000 years), and sums of them could overflow.
constexpr std::uint64_t kLatest_us = 100'000'000'000'000'000;
constexpr float kOnDemand = -1.0F;  // OpenNI2's playback speed: as images are read

}  // namespace

struct OniRecording::Streams {
  openni::Device device;
  openni::VideoStream depth;
  openni::VideoStream color;
  std::array<int, 2> left{};  ///< images of depth and of colour that were not read yet
  Pairing pairing{kPairTolerance_us};

  int stream_count() const { return color.isValid() ? 2 : 1; }
  int images_in(const openni::VideoStream& stream) {
    return device.getPlaybackControl()->getNumberOfFrames(stream);
  }
};

OniRecording::OniRecording(const std::filesystem::path& path)
    : path_(path), streams_(std::make_unique<Streams>()) {
  if (!std::filesystem::is_regular_file(path)) {
    throw std::runtime_error(path.string() + ": no such recording");
  }
  if (openni::OpenNI::initialize() != STATUS_OK) refuse("OpenNI2 does not start");
  if (streams_->device.open(path.c_str()) != STATUS_OK || !streams_->device.isFile()) {
    refuse("cannot be played");
  }
  openni::PlaybackControl& playback = *streams_->device.getPlaybackControl();
  if (playback.setRepeatEnabled(false) != STATUS_OK || playback.setSpeed(kOnDemand) != STATUS_OK) {
    refuse("cannot be played image by image");
  }
  const auto start = [&](openni::VideoStream& stream, openni::SensorType sensor, int& left) {
    if (stream.create(streams_->device, sensor) != STATUS_OK || stream.start() != STATUS_OK) {
      refuse("a stream of it does not start");
    }
    left = streams_->images_in(stream);
  };
  if (!streams_->device.hasSensor(openni::SENSOR_DEPTH)) refuse("has no depth");
  start(streams_->depth, openni::SENSOR_DEPTH, streams_->left[0]);
  if (streams_->device.hasSensor(openni::SENSOR_COLOR)) {
    start(streams_->color, openni::SENSOR_COLOR, streams_->left[1]);
  }
  depth_camera_ = kinect::camera_of(streams_->depth);
  color_camera_ = has_color() ? kinect::camera_of(streams_->color) : PinholeCamera{};
  if (!kinect::is_usable(depth_camera_) || (has_color() && !kinect::is_usable(color_camera_))) {
    refuse("states no field of view");
  }
}

OniRecording::~OniRecording() {
  streams_->pairing = Pairing(kPairTolerance_us);  // images must go before their streams
  keep_open(std::move(streams_));
}

void OniRecording::refuse(const std::string& what) const {
  const std::string detail = openni_error();
  throw std::runtime_error(path_.string() + ": " + what +
                           (detail.empty() ? "" : " (" + detail + ")"));
}

bool OniRecording::has_color() const { return streams_->color.isValid(); }

int OniRecording::depth_images() const { return streams_->images_in(streams_->depth); }

bool OniRecording::next(OniFrame& frame) {
  std::array<openni::VideoStream*, 2> streams = {&streams_->depth, &streams_->color};
  std::optional<Pairing::Pair> pair;
  while (!pair) {
    if (streams_->left[0] + streams_->left[1] == 0) return false;
    int ready = -1;
    const auto status = openni::OpenNI::waitForAnyStream(streams.data(), streams_->stream_count(),
                                                         &ready, kPatience_ms);
    Image image;
    if (status != STATUS_OK ||
        streams[static_cast<std::size_t>(ready)]->readFrame(&image) != STATUS_OK) {
      refuse("ends before its last image");
    }
    --streams_->left[static_cast<std::size_t>(ready)];
    const auto time_us =
        static_cast<std::int64_t>(std::min<std::uint64_t>(image.getTimestamp(), kLatest_us));
    if (ready == 1) {
      pair = streams_->pairing.add_color(time_us, image);
    } else if (has_color()) {
      pair = streams_->pairing.add_depth(time_us, image);
    } else {
      pair = Pairing::Pair{time_us, time_us, image, {}};
    }
    without_color_ = streams_->pairing.depth_unpaired();
  }
  frame.depth_time_us = pair->depth_time_us;
  frame.color = {};
  if (!copy_depth(pair->depth, streams_->depth.getMirroringEnabled(), frame.depth) ||
      (has_color() &&
       !copy_color(pair->color, streams_->color.getMirroringEnabled(), frame.color))) {
    refuse("an image of it is not depth in millimetres, or not RGB888");
  }
  return true;
}

}  // namespace roomwise
