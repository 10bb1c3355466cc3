#include "services/kinect_pub/freenect/freenect_device.h"

#include <OniCProperties.h>
#include <sys/time.h>

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "common/openni2/property_value.h"
#include "services/kinect_pub/freenect/freenect_properties.h"

namespace roomwise {
namespace {

constexpr int kWidth_px = 640;
constexpr int kHeight_px = 480;
constexpr std::size_t kPixels = std::size_t{kWidth_px} * kHeight_px;
constexpr timeval kEventPatience{.tv_sec = 0, .tv_usec = 50'000};

// As calibrations of many a Kinect v1 have them: 580 px for the infrared, 525 px for the colour
// camera, at 640 x 480.
constexpr double kDepthFocal_px = 580.0;
constexpr double kColorFocal_px = 525.0;

// OpenNI2 wants to write to what it is shown.
std::array<OniVideoMode, 4> depth_modes{{{ONI_PIXEL_FORMAT_DEPTH_1_MM, 640, 480, 30},
                                         {ONI_PIXEL_FORMAT_DEPTH_1_MM, 320, 240, 30},
                                         {ONI_PIXEL_FORMAT_SHIFT_9_2, 640, 480, 30},
                                         {ONI_PIXEL_FORMAT_SHIFT_9_2, 320, 240, 30}}};
std::array<OniVideoMode, 2> color_modes{
    {{ONI_PIXEL_FORMAT_RGB888, 640, 480, 30}, {ONI_PIXEL_FORMAT_RGB888, 320, 240, 30}}};
std::array<OniSensorInfo, 2> sensor_infos{
    {{ONI_SENSOR_DEPTH, static_cast<int>(depth_modes.size()), depth_modes.data()},
     {ONI_SENSOR_COLOR, static_cast<int>(color_modes.size()), color_modes.data()}}};

float field_of_view_rad(int size_px, double focal_px) {
  return static_cast<float>(2.0 * std::atan(size_px / (2.0 * focal_px)));
}

double radians(double angle_deg) { return angle_deg * std::numbers::pi / 180.0; }
double degrees(double angle_rad) { return angle_rad * 180.0 / std::numbers::pi; }

/// Every second pixel of every second row.
template <std::size_t kValues, class Value>
void take_every_second(const Value* pixels, std::vector<Value>& out) {
  out.resize(kPixels / 4 * kValues);
  Value* to = out.data();
  for (std::size_t v = 0; v < kHeight_px; v += 2) {
    for (std::size_t u = 0; u < kWidth_px; u += 2) {
      const Value* from = pixels + (v * kWidth_px + u) * kValues;
      to = std::copy_n(from, kValues, to);
    }
  }
}

kinect::ZeroPlane zero_plane_of(freenect_device* device) {
  if (!freenect_is_whole()) return {};
  freenect_registration registration = freenect_copy_registration(device);
  const freenect_zero_plane_info& info = registration.zero_plane_info;
  kinect::ZeroPlane plane{.distance = static_cast<double>(info.reference_distance),
                          .pixel_size = static_cast<double>(info.reference_pixel_size),
                          .baseline = static_cast<double>(info.dcmos_emitter_dist),
                          .shift_offset = registration.const_shift};
  freenect_destroy_registration(&registration);
  const bool stated = plane.distance > 0.0 && plane.pixel_size > 0.0 && plane.baseline > 0.0;
  return stated ? plane : kinect::ZeroPlane{};
}

freenect_device* open(const FreenectContext& context, const std::string& name) {
  freenect_device* device = nullptr;
  int index = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), index);
  const bool is_index = error == std::errc() && end == name.data() + name.size() && index < 100;
  const int status =
      is_index ? freenect_open_device(context.get(), &device, index)
               : freenect_open_device_by_camera_serial(context.get(), &device, name.c_str());
  if (status < 0 || device == nullptr) {
    throw std::runtime_error("Kinect " + name + " cannot be opened: " + last_freenect_message());
  }
  return device;
}

}  // namespace

FreenectDevice::FreenectDevice(const std::string& name)
    : name_(name),
      device_(open(context_, name)),
      table_(kinect::shift_table(zero_plane_of(device_))) {
  freenect_set_user(device_, this);
  freenect_set_depth_callback(device_, &FreenectDevice::on_depth);
  freenect_set_video_callback(device_, &FreenectDevice::on_color);
  server_ = std::thread([this] { serve_events(); });
}

FreenectDevice::~FreenectDevice() {
  stopping_ = true;
  server_.join();
  freenect_close_device(device_);
}

void FreenectDevice::serve_events() {
  while (!stopping_) {
    timeval patience = kEventPatience;
    if (freenect_process_events_timeout(context_.get(), &patience) < 0) {
      gone_ = true;
      return;
    }
  }
}

void FreenectDevice::on_depth(freenect_device* device, void* pixels, std::uint32_t ticks) {
  static_cast<FreenectDevice*>(freenect_get_user(device))
      ->deliver_depth(static_cast<const std::uint16_t*>(pixels), ticks);
}

void FreenectDevice::on_color(freenect_device* device, void* pixels, std::uint32_t ticks) {
  static_cast<FreenectDevice*>(freenect_get_user(device))
      ->deliver_color(static_cast<const std::uint8_t*>(pixels), ticks);
}

FreenectDevice::Streams FreenectDevice::streams_of(OniSensorType sensor) {
  const std::lock_guard lock(mutex_);
  Streams found;
  for (const auto& stream : streams_) {
    if (stream->sensor() == sensor) found.push_back(stream);
  }
  return found;
}

void FreenectDevice::deliver_depth(const std::uint16_t* words, std::uint32_t ticks) {
  DriverImage image{.time_us = clock_.time_us(ticks)};
  image.number = image.time_us / 33'333;
  for (const auto& stream : streams_of(ONI_SENSOR_DEPTH)) {
    const OniVideoMode mode = stream->mode();
    depth_.assign(words, words + kPixels);
    const bool to_depths = mode.pixelFormat == ONI_PIXEL_FORMAT_DEPTH_1_MM && !registered_;
    if (to_depths) kinect::shifts_to_depths(table_, depth_);
    image.pixels = depth_.data();
    if (mode.resolutionX < kWidth_px) {
      take_every_second<1>(depth_.data(), small_depth_);
      image.pixels = small_depth_.data();
    }
    image.width_px = mode.resolutionX;
    image.height_px = mode.resolutionY;
    stream->deliver(image);
  }
}

void FreenectDevice::deliver_color(const std::uint8_t* rgb, std::uint32_t ticks) {
  DriverImage image{.time_us = clock_.time_us(ticks)};
  image.number = image.time_us / 33'333;
  for (const auto& stream : streams_of(ONI_SENSOR_COLOR)) {
    const OniVideoMode mode = stream->mode();
    image.pixels = rgb;
    if (mode.resolutionX < kWidth_px) {
      take_every_second<3>(rgb, small_color_);
      image.pixels = small_color_.data();
    }
    image.width_px = mode.resolutionX;
    image.height_px = mode.resolutionY;
    stream->deliver(image);
  }
}

bool FreenectDevice::start_depth() {
  const freenect_depth_format format =
      registered_ ? FREENECT_DEPTH_REGISTERED : FREENECT_DEPTH_11BIT;
  const freenect_frame_mode mode = freenect_find_depth_mode(FREENECT_RESOLUTION_MEDIUM, format);
  depth_runs_ = mode.is_valid != 0 && freenect_set_depth_mode(device_, mode) >= 0 &&
                freenect_start_depth(device_) >= 0;
  return depth_runs_;
}

bool FreenectDevice::start_color() {
  const freenect_frame_mode mode =
      freenect_find_video_mode(FREENECT_RESOLUTION_MEDIUM, FREENECT_VIDEO_RGB);
  return mode.is_valid != 0 && freenect_set_video_mode(device_, mode) >= 0 &&
         freenect_start_video(device_) >= 0;
}

void FreenectDevice::stop(OniSensorType sensor) {
  if (sensor == ONI_SENSOR_COLOR) {
    freenect_stop_video(device_);
    return;
  }
  freenect_stop_depth(device_);
  depth_runs_ = false;
}

ImageStreamSettings FreenectDevice::settings_of(OniSensorType sensor) {
  const bool is_depth = sensor == ONI_SENSOR_DEPTH;
  const double focal_px = is_depth ? kDepthFocal_px : kColorFocal_px;
  ImageStreamSettings settings{.sensor = sensor,
                               .modes = {color_modes.begin(), color_modes.end()},
                               .horizontal_fov_rad = field_of_view_rad(kWidth_px, focal_px),
                               .vertical_fov_rad = field_of_view_rad(kHeight_px, focal_px),
                               .mirrored = false,
                               .start = [this] { return start_color(); },
                               .stop = [this, sensor] { stop(sensor); },
                               .mode_changed = [] {}};
  if (is_depth) {
    settings.modes = {depth_modes.begin(), depth_modes.end()};
    settings.start = [this] { return start_depth(); };
  }
  return settings;
}

OniStatus FreenectDevice::getSensorInfoList(OniSensorInfo** sensors, int* count) {
  *sensors = sensor_infos.data();
  *count = static_cast<int>(sensor_infos.size());
  return ONI_STATUS_OK;
}

oni::driver::StreamBase* FreenectDevice::createStream(OniSensorType sensor) {
  if (sensor != ONI_SENSOR_DEPTH && sensor != ONI_SENSOR_COLOR) return nullptr;
  const auto stream = std::make_shared<ImageStream>(settings_of(sensor));
  stream->set_registered(registered_);
  const std::lock_guard lock(mutex_);
  streams_.push_back(stream);
  return stream.get();
}

void FreenectDevice::destroyStream(oni::driver::StreamBase* stream) {
  const std::lock_guard lock(mutex_);
  std::erase_if(streams_, [stream](const auto& candidate) { return candidate.get() == stream; });
}

OniStatus FreenectDevice::set_registration(const void* data, int size) {
  OniImageRegistrationMode mode{};
  const OniStatus status = take_value(data, size, mode);
  if (status != ONI_STATUS_OK) return status;
  if (isImageRegistrationModeSupported(mode) == FALSE) return ONI_STATUS_NOT_SUPPORTED;
  const bool registered = mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR;
  if (registered == registered_) return ONI_STATUS_OK;
  const bool restart = depth_runs_;
  if (restart) stop(ONI_SENSOR_DEPTH);
  registered_ = registered;
  for (const auto& stream : streams_of(ONI_SENSOR_DEPTH)) stream->set_registered(registered);
  return !restart || start_depth() ? ONI_STATUS_OK : ONI_STATUS_ERROR;
}

OniStatus FreenectDevice::set_tilt(const void* data, int size) {
  double tilt_rad = 0.0;
  const OniStatus status = take_value(data, size, tilt_rad);
  if (status != ONI_STATUS_OK) return status;
  if (!(std::abs(degrees(tilt_rad)) <= 31.0)) return ONI_STATUS_BAD_PARAMETER;
  return freenect_set_tilt_degs(device_, degrees(tilt_rad)) < 0 ? ONI_STATUS_ERROR : ONI_STATUS_OK;
}

OniStatus FreenectDevice::setProperty(int id, const void* data, int size) {
  if (id == ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION) return set_registration(data, size);
  if (id == kFreenectTilt_rad) return set_tilt(data, size);
  return ONI_STATUS_NOT_SUPPORTED;
}

OniStatus FreenectDevice::give_acceleration(void* data, int* size) {
  std::array<double, 3> acceleration_mps2{};
  freenect_get_mks_accel(freenect_get_tilt_state(device_), &acceleration_mps2[0],
                         &acceleration_mps2[1], &acceleration_mps2[2]);
  return give_value(acceleration_mps2, data, size);
}

OniStatus FreenectDevice::getProperty(int id, void* data, int* size) {
  const bool asks_motor = id == kFreenectTilt_rad || id == kFreenectAcceleration_mps2;
  if (asks_motor && freenect_update_tilt_state(device_) < 0) return ONI_STATUS_ERROR;
  switch (id) {
    case ONI_DEVICE_PROPERTY_DRIVER_VERSION:
      return give_value(OniVersion{0, 1, 0, 0}, data, size);
    case ONI_DEVICE_PROPERTY_HARDWARE_VERSION:
      return give_value(int{1}, data, size);
    case ONI_DEVICE_PROPERTY_SERIAL_NUMBER:
      return give_text(name_, data, size);
    case ONI_DEVICE_PROPERTY_ERROR_STATE:
      return give_value(int{gone_ ? ONI_DEVICE_STATE_ERROR : ONI_DEVICE_STATE_OK}, data, size);
    case ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION:
      return give_value(
          registered_ ? ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR : ONI_IMAGE_REGISTRATION_OFF, data,
          size);
    case kFreenectTilt_rad:
      return give_value(radians(freenect_get_tilt_degs(freenect_get_tilt_state(device_))), data,
                        size);
    case kFreenectAcceleration_mps2:
      return give_acceleration(data, size);
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniBool FreenectDevice::isPropertySupported(int id) {
  const bool own = id == kFreenectTilt_rad || id == kFreenectAcceleration_mps2;
  const bool common =
      id >= ONI_DEVICE_PROPERTY_DRIVER_VERSION && id <= ONI_DEVICE_PROPERTY_IMAGE_REGISTRATION;
  return own || common ? TRUE : FALSE;
}

OniBool FreenectDevice::isImageRegistrationModeSupported(OniImageRegistrationMode mode) {
  // Registration needs what the device says of its own geometry; a made-up device says nothing.
  if (mode == ONI_IMAGE_REGISTRATION_DEPTH_TO_COLOR) return freenect_is_whole() ? TRUE : FALSE;
  return mode == ONI_IMAGE_REGISTRATION_OFF ? TRUE : FALSE;
}

}  // namespace roomwise
