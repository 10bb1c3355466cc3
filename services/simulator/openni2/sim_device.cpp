#include "services/simulator/openni2/sim_device.h"

#include <OniCProperties.h>

#include "services/simulator/openni2/property_value.h"

namespace roomwise::simulator {
namespace {

/// How soon a closed device's thread ends.
constexpr std::chrono::milliseconds kLongestWait{50};

}  // namespace

SimDevice::SimDevice(const std::filesystem::path& path)
    : reader_(path),
      sensors_{SimStream::describe(ONI_SENSOR_DEPTH), SimStream::describe(ONI_SENSOR_COLOR)},
      carrier_([this] { carry_frames(); }) {}

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
  std::vector<std::shared_ptr<SimStream>> streams;
  {
    const std::lock_guard lock(mutex_);
    if (frame.depth_registered == registered_) streams = streams_;
  }
  for (const auto& stream : streams) stream->deliver(frame);
}

void SimDevice::ask_for_frames() {
  const std::lock_guard lock(mutex_);
  FrameRequest request{.depth_registered = registered_};
  for (const auto& stream : streams_) {
    stream->set_registered(registered_);
    (stream->sensor() == ONI_SENSOR_DEPTH ? request.depth_width_px : request.color_width_px) =
        stream->width_px();
  }
  reader_.ask(request);
}

OniStatus SimDevice::getSensorInfoList(OniSensorInfo** sensors, int* count) {
  *sensors = sensors_.data();
  *count = static_cast<int>(sensors_.size());
  return ONI_STATUS_OK;
}

oni::driver::StreamBase* SimDevice::createStream(OniSensorType sensor) {
  if (sensor != ONI_SENSOR_DEPTH && sensor != ONI_SENSOR_COLOR) return nullptr;
  const auto stream = std::make_shared<SimStream>(
      sensor, sensor == ONI_SENSOR_DEPTH ? reader_.depth_camera() : reader_.color_camera(),
      [this] { ask_for_frames(); });
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
