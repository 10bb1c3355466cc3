#include "services/simulator/openni2/sim_device.h"

#include <OniCProperties.h>

#include <array>
#include <cmath>

#include "common/openni2/property_value.h"

namespace roomwise::simulator {
namespace {

/// How soon a closed device's thread ends.
constexpr std::chrono::milliseconds kLongestWait{50};

// OpenNI2 wants to write to what it is shown.
std::array<OniVideoMode, 2> depth_modes{
    {{ONI_PIXEL_FORMAT_DEPTH_1_MM, 640, 480, 30}, {ONI_PIXEL_FORMAT_DEPTH_1_MM, 320, 240, 30}}};
std::array<OniVideoMode, 2> color_modes{
    {{ONI_PIXEL_FORMAT_RGB888, 640, 480, 30}, {ONI_PIXEL_FORMAT_RGB888, 320, 240, 30}}};
std::array<OniSensorInfo, 2> sensor_infos{
    {{ONI_SENSOR_DEPTH, static_cast<int>(depth_modes.size()), depth_modes.data()},
     {ONI_SENSOR_COLOR, static_cast<int>(color_modes.size()), color_modes.data()}}};

DriverImage image_for(OniSensorType sensor, const DoorFrame& frame) {
  const bool is_depth = sensor == ONI_SENSOR_DEPTH;
  return {.pixels = is_depth ? static_cast<const void*>(frame.depth_mm.data()) : frame.rgb.data(),
          .width_px = is_depth ? frame.depth_width_px : frame.color_width_px,
          .height_px = is_depth ? frame.depth_height_px : frame.color_height_px,
          .time_us = frame.device_time_us,
          .number = frame.number};
}

}  // namespace

SimDevice::SimDevice(const std::filesystem::path& path)
    : reader_(path), carrier_([this] { carry_frames(); }) {}

SimDevice::~SimDevice() {
  stopping_ = true;
  carrier_.join();
}

void SimDevice::carry_frames() {
  DoorFrame frame;
  while (!stopping_) {
    const FrameDoorReader::Wait result = reader_.next(frame, kLongestWait);
    if (result == FrameDoorReader::Wait::kGone) return;
    if (result == FrameDoorReader::Wait::kFrame) deliver(frame);
  }
}

void SimDevice::deliver(const DoorFrame& frame) {
  std::vector<std::shared_ptr<ImageStream>> streams;
  {
    const std::lock_guard lock(mutex_);
    if (frame.depth_registered == registered_) streams = streams_;
  }
  for (const auto& stream : streams) stream->deliver(image_for(stream->sensor(), frame));
}

void SimDevice::ask_for_frames() {
  const std::lock_guard lock(mutex_);
  FrameRequest request{.depth_registered = registered_};
  for (const auto& stream : streams_) {
    stream->set_registered(registered_);
    (stream->sensor() == ONI_SENSOR_DEPTH ? request.depth_width_px : request.color_width_px) =
        stream->mode().resolutionX;
  }
  reader_.ask(request);
}

OniStatus SimDevice::getSensorInfoList(OniSensorInfo** sensors, int* count) {
  *sensors = sensor_infos.data();
  *count = static_cast<int>(sensor_infos.size());
  return ONI_STATUS_OK;
}

ImageStreamSettings SimDevice::settings_of(OniSensorType sensor) {
  const bool is_depth = sensor == ONI_SENSOR_DEPTH;
  const auto& modes = is_depth ? depth_modes : color_modes;
  const PinholeCamera& camera = is_depth ? reader_.depth_camera() : reader_.color_camera();
  return {.sensor = sensor,
          .modes = {modes.begin(), modes.end()},
          .horizontal_fov_rad = static_cast<float>(2.0 * std::atan(320.0 / camera.fx_px)),
          .vertical_fov_rad = static_cast<float>(2.0 * std::atan(240.0 / camera.fy_px)),
          .mirrored = true,  // as the cameras it stands in for are
          .start = [] { return true; },
          .stop = [] {},
          .mode_changed = [this] { ask_for_frames(); }};
}

oni::driver::StreamBase* SimDevice::createStream(OniSensorType sensor) {
  if (sensor != ONI_SENSOR_DEPTH && sensor != ONI_SENSOR_COLOR) return nullptr;
  const auto stream = std::make_shared<ImageStream>(settings_of(sensor));
  {
    const std::lock_guard lock(mutex_);
    streams_.push_back(stream);
  }
  ask_for_frames();
  return stream.get();
}

void SimDevice::destroyStream(oni::driver::StreamBase* stream) {
  const std::lock_guard lock(mutex_);
  std::erase_if(streams_, [stream](const auto& candidate) { return candidate.get() == stream; });
}

OniStatus SimDevice::setProperty(int id, const void* data, int size) {
  if (id != ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) return ONI_STATUS_NOT_SUPPORTED;
  OniImageRegistrationMode mode{};
  const OniStatus status = take_value(data, size, mode);
  if (status != ONI_STATUS_OK) return status;
  if (isImageRegistrationModeSupported(mode) == FALSE) return ONI_STATUS_NOT_SUPPORTED;
  {
    const std::lock_guard lock(mutex_);
    registered_ = mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  }
  ask_for_frames();
  return ONI_STATUS_OK;
}

OniStatus SimDevice::getProperty(int id, void* data, int* size) {
  const std::lock_guard lock(mutex_);
  switch (id) {
    case ONI_DEVICE_PROPERTY_FIRMWARE_VERSION:
      return give_text("simulated", data, size);
    case ONI_DEVICE_PROPERTY_DRIVER_VERSION:
      return give_value(OniVersion{0, 1, 0, 0}, data, size);
    case ONI_DEVICE_PROPERTY_HARDWARE_VERSION:
      return give_value(int{1}, data, size);
    case ONI_DEVICE_PROPERTY_SERIAL_NUMBER:
      return give_text(reader_.serial(), data, size);
    case ONI_DEVICE_PROPERTY_ERROR_STATE:
      return give_value(int{reader_.is_served() ? ONI_DEVICE_STATE_OK : ONI_DEVICE_STATE_ERROR},
                        data, size);
    case ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION:
      return give_value(
          registered_ ? ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR : ONI_IMAGE_REGISTRATION_OFF, data,
          size);
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniBool SimDevice::isPropertySupported(int id) {
  return id >= ONI_DEVICE_PROPERTY_FIRMWARE_VERSION && id <= ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION
             ? TRUE
             : FALSE;
}

OniBool SimDevice::isImageRegistrationModeSupported(OniImageRegistrationMode mode) {
  return mode == ONI_IMAGE_REGISTRATION_OFF || mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR
             ? TRUE
             : FALSE;
}

}  // namespace roomwise::simulator
