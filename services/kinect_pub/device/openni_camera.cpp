#include "services/kinect_pub/device/openni_camera.h"

#include <OpenNI.h>

#include <array>
#include <stdexcept>
#include <utility>

#include "common/openni2/keep_open.h"
#include "common/openni2/openni_error.h"
#include "common/openni2/openni_images.h"
#include "services/kinect_pub/core/camera_geometry.h"

namespace roomwise {
namespace {

constexpr int kFrameRate_hz = 30;

openni::PixelFormat format_of(openni::SensorType sensor) {
  return sensor == openni::SENSOR_DEPTH ? openni::PIXEL_FORMAT_DEPTH_1_MM
                                        : openni::PIXEL_FORMAT_RGB888;
}

std::string serial_of(const openni::Device& device) {
  std::array<char, ONI_MAX_STR> text{};
  int size = static_cast<int>(text.size()) - 1;
  const auto status = device.getProperty(openni::DEVICE_PROPERTY_SERIAL_NUMBER, text.data(), &size);
  return status == openni::STATUS_OK ? std::string(text.data()) : std::string();
}

}  // namespace

void OpenedStreams::close() {
  depth.destroy();
  color.destroy();
  device.close();
}

OpenNiCamera::OpenNiCamera(OpenNiLibrary& library, const CameraRequest& request)
    : library_(library), request_(request), pairing_(request.pair_tolerance_us) {
  try {
    open_device();
    open_stream(depth_, openni::SENSOR_DEPTH, "depth");
    if (request_.use_color) open_stream(color_, openni::SENSOR_COLOR, "colour");
    set_registration();
    start(depth_, "depth");
    if (request_.use_color) start(color_, "colour");
    describe();
  } catch (...) {
    streams_->close();
    throw;
  }
}

OpenNiCamera::~OpenNiCamera() {
  pairing_ = Pairing(request_.pair_tolerance_us);  // frames must go before their streams
  if (facts_.is_recording) {
    keep_open(std::move(streams_));
  } else {
    streams_->close();
  }
}

void OpenNiCamera::refuse(const std::string& what) const {
  const std::string device = facts_.uri.empty() ? request_.uri : facts_.name + " " + facts_.uri;
  const std::string detail = openni_error();
  throw std::runtime_error(device + ": " + what + (detail.empty() ? "" : " (" + detail + ")"));
}

void OpenNiCamera::open_device() {
  const char* uri = request_.uri.empty() ? openni::ANY_DEVICE : request_.uri.c_str();
  if (device_.open(uri) != openni::STATUS_OK) {
    if (uri == openni::ANY_DEVICE) throw std::runtime_error("no camera is connected");
    refuse("cannot be opened");
  }
  const openni::DeviceInfo& info = device_.getDeviceInfo();
  facts_.name = std::string(info.getVendor()) + " " + info.getName();
  facts_.uri = info.getUri();
  facts_.is_recording = device_.isFile();
  losses_before_ = library_.losses(facts_.uri);
  library_.start_over(facts_.uri);
  if (facts_.is_recording) {
    device_.getPlaybackControl()->setRepeatEnabled(request_.loop_recording);
  }
}

void OpenNiCamera::open_stream(openni::VideoStream& stream, openni::SensorType sensor,
                               const char* name) {
  if (!device_.hasSensor(sensor)) refuse(std::string("has no ") + name + " sensor");
  if (stream.create(device_, sensor) != openni::STATUS_OK) {
    refuse(std::string("its ") + name + " stream cannot be made");
  }
  if (!facts_.is_recording) choose_mode(stream, sensor, name);
  stream.setMirroringEnabled(false);
}

void OpenNiCamera::choose_mode(openni::VideoStream& stream, openni::SensorType sensor,
                               const char* name) {
  openni::VideoMode mode;
  mode.setPixelFormat(format_of(sensor));
  mode.setResolution(request_.width_px, request_.height_px);
  mode.setFps(kFrameRate_hz);
  if (stream.setVideoMode(mode) != openni::STATUS_OK) {
    refuse(std::string("has no ") + name + " mode of " + std::to_string(request_.width_px) + " x " +
           std::to_string(request_.height_px) + " at " + std::to_string(kFrameRate_hz) + " Hz");
  }
}

void OpenNiCamera::set_registration() {
  using openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  using openni::IMAGE_REGISTRATION_OFF;
  const bool on = request_.register_depth && request_.use_color &&
                  device_.isImageRegistrationModeSupported(IMAGE_REGISTRATION_DEPTH_TO_COLOR);
  device_.setImageRegistrationMode(on ? IMAGE_REGISTRATION_DEPTH_TO_COLOR : IMAGE_REGISTRATION_OFF);
}

void OpenNiCamera::start(openni::VideoStream& stream, const char* name) {
  if (stream.start() != openni::STATUS_OK) {
    refuse(std::string("its ") + name + " stream does not start");
  }
}

void OpenNiCamera::describe() {
  facts_.serial = serial_of(device_);
  facts_.depth_registered = facts_.is_recording ? request_.recording_is_registered
                                                : device_.getImageRegistrationMode() ==
                                                      openni::IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  depth_mirrored_ = depth_.getMirroringEnabled();
  color_mirrored_ = request_.use_color && color_.getMirroringEnabled();
  facts_.mirrored_by_device = depth_mirrored_ || color_mirrored_;
  facts_.depth_width_px = depth_.getVideoMode().getResolutionX();
  facts_.depth_height_px = depth_.getVideoMode().getResolutionY();
  facts_.depth_camera = kinect::camera_of(depth_);
  if (request_.use_color) {
    facts_.color_width_px = color_.getVideoMode().getResolutionX();
    facts_.color_height_px = color_.getVideoMode().getResolutionY();
    facts_.color_camera = kinect::camera_of(color_);
    // Registered depth is the depth that the colour camera would see.
    if (facts_.depth_registered) {
      facts_.depth_camera = kinect::camera_from_fields_of_view(
          facts_.depth_width_px, facts_.depth_height_px, color_.getHorizontalFieldOfView(),
          color_.getVerticalFieldOfView());
    }
  }
  if (!kinect::is_usable(facts_.depth_camera) ||
      (request_.use_color && !kinect::is_usable(facts_.color_camera))) {
    refuse("states no field of view");
  }
}

OpenNiCamera::Read OpenNiCamera::read(std::chrono::milliseconds patience, CapturedFrame& frame) {
  if (library_.losses(facts_.uri) != losses_before_) return Read::kLost;
  std::array<openni::VideoStream*, 2> streams{&depth_, &color_};
  int ready = -1;
  const auto status = openni::OpenNI::waitForAnyStream(streams.data(), request_.use_color ? 2 : 1,
                                                       &ready, static_cast<int>(patience.count()));
  if (status != openni::STATUS_OK) {
    return library_.at_end(facts_.uri) ? Read::kEnded : Read::kNothing;
  }
  const auto pair = take_image(ready);
  if (!pair) return Read::kNothing;
  if (fill(*pair, frame)) return Read::kPair;
  ++malformed_;
  return Read::kNothing;
}

std::optional<OpenNiCamera::Pairing::Pair> OpenNiCamera::take_image(int stream_index) {
  Image image;
  openni::VideoStream& stream = stream_index == 0 ? depth_ : color_;
  if (stream.readFrame(&image) != openni::STATUS_OK || !image.isValid()) return std::nullopt;
  const auto time_us = static_cast<std::int64_t>(image.getTimestamp());
  if (stream_index == 1) return pairing_.add_color(time_us, image);
  if (!request_.use_color) return Pairing::Pair{time_us, time_us, image, {}};
  return pairing_.add_depth(time_us, image);
}

bool OpenNiCamera::fill(const Pairing::Pair& pair, CapturedFrame& frame) {
  if (!copy_depth(pair.depth, depth_mirrored_, frame.depth)) return false;
  if (pair.color.isValid()) {
    if (!copy_color(pair.color, color_mirrored_, frame.color)) return false;
  } else {
    frame.color = {};
  }
  frame.device_time_us = pair.depth_time_us;
  frame.depth_registered = facts_.depth_registered;
  frame.depth_camera = facts_.depth_camera;
  frame.color_camera = facts_.color_camera;
  return true;
}

}  // namespace roomwise
