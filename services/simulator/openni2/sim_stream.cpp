#include "services/simulator/openni2/sim_stream.h"

#include <OniCProperties.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "services/simulator/openni2/property_value.h"

namespace roomwise::simulator {
namespace {

constexpr int kMaxDepth_mm = 10000;

std::array<OniVideoMode, 2> modes(OniPixelFormat format) {
  return {{{format, 640, 480, 30}, {format, 320, 240, 30}}};
}

std::array<OniVideoMode, 2>& offered_modes(OniSensorType sensor) {
  static std::array<OniVideoMode, 2> depth = modes(ONI_PIXEL_FORMAT_DEPTH_1_MM);
  static std::array<OniVideoMode, 2> color = modes(ONI_PIXEL_FORMAT_RGB888);
  return sensor == ONI_SENSOR_DEPTH ? depth : color;
}

bool operator==(const OniVideoMode& a, const OniVideoMode& b) {
  return a.pixelFormat == b.pixelFormat && a.resolutionX == b.resolutionX &&
         a.resolutionY == b.resolutionY && a.fps == b.fps;
}

int property_size(int id) {
  if (id == ONI_STREAM_PROPERTY_CROPPING) return sizeof(OniCropping);
  if (id == ONI_STREAM_PROPERTY_VIDEO_MODE) return sizeof(OniVideoMode);
  return sizeof(int);
}

/// Copies `pixels` pixels in reverse order.
template <std::size_t kBytes>
void copy_reversed(const std::uint8_t* from, int pixels, std::uint8_t* to) {
  for (int i = 0; i < pixels; ++i) {
    std::memcpy(to + kBytes * static_cast<std::size_t>(i),
                from + kBytes * static_cast<std::size_t>(pixels - 1 - i), kBytes);
  }
}

}  // namespace

SimStream::SimStream(OniSensorType sensor, const PinholeCamera& camera,
                     std::function<void()> mode_changed)
    : sensor_(sensor),
      camera_(camera),
      mode_changed_(std::move(mode_changed)),
      mode_(offered_modes(sensor)[0]) {}

OniSensorInfo SimStream::describe(OniSensorType sensor) {
  auto& offered = offered_modes(sensor);
  return {sensor, static_cast<int>(offered.size()), offered.data()};
}

OniStatus SimStream::start() {
  const std::lock_guard lock(mutex_);
  running_ = true;
  return ONI_STATUS_OK;
}

void SimStream::stop() {
  const std::lock_guard lock(mutex_);
  running_ = false;
}

int SimStream::width_px() const {
  const std::lock_guard lock(mutex_);
  return mode_.resolutionX;
}

void SimStream::set_registered(bool registered) {
  const std::lock_guard lock(mutex_);
  registered_ = registered;
}

OniStatus SimStream::set_mode(const OniVideoMode& mode) {
  const auto& offered = offered_modes(sensor_);
  const bool is_offered = std::ranges::any_of(
      offered, [&](const OniVideoMode& candidate) { return candidate == mode; });
  if (!is_offered) return ONI_STATUS_NOT_SUPPORTED;
  if (mode == mode_) return ONI_STATUS_OK;
  if (running_) return ONI_STATUS_OUT_OF_FLOW;
  mode_ = mode;
  cropping_ = {};
  return ONI_STATUS_OK;
}

OniStatus SimStream::set_cropping(const OniCropping& cropping) {
  if (cropping.enabled != FALSE) {
    const bool inside = cropping.originX >= 0 && cropping.originY >= 0 && cropping.width > 0 &&
                        cropping.height > 0 &&
                        cropping.width <= mode_.resolutionX - cropping.originX &&
                        cropping.height <= mode_.resolutionY - cropping.originY;
    if (!inside) return ONI_STATUS_BAD_PARAMETER;
  }
  cropping_ = cropping;
  return ONI_STATUS_OK;
}

OniStatus SimStream::setProperty(int id, const void* data, int size) {
  if (id == ONI_STREAM_PROPERTY_VIDEO_MODE) {
    OniVideoMode mode{};
    OniStatus status = take_value(data, size, mode);
    if (status == ONI_STATUS_OK) {
      const std::lock_guard lock(mutex_);
      status = set_mode(mode);
    }
    if (status == ONI_STATUS_OK) mode_changed_();
    return status;
  }
  const std::lock_guard lock(mutex_);
  switch (id) {
    case ONI_STREAM_PROPERTY_CROPPING: {
      OniCropping cropping{};
      const OniStatus status = take_value(data, size, cropping);
      return status == ONI_STATUS_OK ? set_cropping(cropping) : status;
    }
    case ONI_STREAM_PROPERTY_MIRRORING:
      return take_value(data, size, mirrored_);
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
      return take_value(data, size, auto_white_balance_);
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
      return take_value(data, size, auto_exposure_);
    default:
      return ONI_STATUS_NOT_SUPPORTED;
  }
}

OniStatus SimStream::getProperty(int id, void* data, int* size) {
  const std::lock_guard lock(mutex_);
  if (isPropertySupported(id) == FALSE) return ONI_STATUS_NOT_SUPPORTED;
  switch (id) {
    case ONI_STREAM_PROPERTY_CROPPING:
      return give_value(cropping_, data, size);
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
      return give_value(field_of_view_rad(id), data, size);
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return give_value(mode_, data, size);
    case ONI_STREAM_PROPERTY_MAX_VALUE:
      return give_value(sensor_ == ONI_SENSOR_DEPTH ? kMaxDepth_mm : 255, data, size);
    case ONI_STREAM_PROPERTY_MIN_VALUE:
      return give_value(int{0}, data, size);
    case ONI_STREAM_PROPERTY_STRIDE:
      return give_value(stride(), data, size);
    case ONI_STREAM_PROPERTY_MIRRORING:
      return give_value(mirrored_, data, size);
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
      return give_value(auto_white_balance_, data, size);
    default:
      return give_value(auto_exposure_, data, size);
  }
}

OniBool SimStream::isPropertySupported(int id) {
  switch (id) {
    case ONI_STREAM_PROPERTY_CROPPING:  // without it a recording plays back no frames
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
    case ONI_STREAM_PROPERTY_MAX_VALUE:
    case ONI_STREAM_PROPERTY_MIN_VALUE:
    case ONI_STREAM_PROPERTY_STRIDE:
    case ONI_STREAM_PROPERTY_MIRRORING:
      return TRUE;
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
      return sensor_ == ONI_SENSOR_COLOR ? TRUE : FALSE;
    default:
      return FALSE;
  }
}

void SimStream::notifyAllProperties() {
  for (int id = 0; id <= ONI_STREAM_PROPERTY_AUTO_EXPOSURE; ++id) {
    if (isPropertySupported(id) == FALSE) continue;
    std::array<std::uint8_t, sizeof(OniCropping)> value{};
    int size = property_size(id);
    getProperty(id, value.data(), &size);
    raisePropertyChanged(id, value.data(), size);
  }
}

OniStatus SimStream::convertDepthToColorCoordinates(oni::driver::StreamBase* color, int depth_x,
                                                    int depth_y, OniDepthPixel /*depth_z*/,
                                                    int* color_x, int* color_y) {
  const std::lock_guard lock(mutex_);
  if (!registered_) return ONI_STATUS_NOT_SUPPORTED;
  const int color_width_px = static_cast<SimStream*>(color)->width_px();
  *color_x = depth_x * color_width_px / mode_.resolutionX;
  *color_y = depth_y * color_width_px / mode_.resolutionX;
  return ONI_STATUS_OK;
}

int SimStream::stride() const {
  const int width_px = cropping_.enabled != FALSE ? cropping_.width : mode_.resolutionX;
  return width_px * bytes_per_pixel();
}

float SimStream::field_of_view_rad(int id) const {
  return id == ONI_STREAM_PROPERTY_HORIZONTAL_FOV
             ? static_cast<float>(2.0 * std::atan(320.0 / camera_.fx_px))
             : static_cast<float>(2.0 * std::atan(240.0 / camera_.fy_px));
}

SimStream::Image SimStream::image_in(const DoorFrame& frame) const {
  if (sensor_ == ONI_SENSOR_DEPTH) {
    return {reinterpret_cast<const std::uint8_t*>(frame.depth_mm.data()), frame.depth_width_px,
            frame.depth_height_px};
  }
  return {frame.rgb.data(), frame.color_width_px, frame.color_height_px};
}

void SimStream::deliver(const DoorFrame& frame) {
  const std::lock_guard lock(mutex_);
  const Image image = image_in(frame);
  if (!running_ || image.width_px != mode_.resolutionX) return;
  OniFrame* out = getServices().acquireFrame();
  if (out == nullptr) return;
  const bool cropped = cropping_.enabled != FALSE;
  out->sensorType = sensor_;
  out->timestamp = static_cast<std::uint64_t>(frame.device_time_us);
  out->frameIndex = static_cast<int>(frame.number);
  out->videoMode = mode_;
  out->croppingEnabled = cropping_.enabled;
  out->cropOriginX = cropped ? cropping_.originX : 0;
  out->cropOriginY = cropped ? cropping_.originY : 0;
  out->width = cropped ? cropping_.width : image.width_px;
  out->height = cropped ? cropping_.height : image.height_px;
  out->stride = stride();
  out->dataSize = out->stride * out->height;
  copy_rows(image, *out);
  raiseNewFrame(out);
  getServices().releaseFrame(out);
}

void SimStream::copy_rows(const Image& image, OniFrame& out) const {
  const auto pixel = static_cast<std::size_t>(bytes_per_pixel());
  const auto row_size = pixel * static_cast<std::size_t>(image.width_px);
  // A cropped rectangle is one of the image as delivered: mirrored first, if it is.
  const int first =
      mirrored_ != FALSE ? image.width_px - out.cropOriginX - out.width : out.cropOriginX;
  for (int row = 0; row < out.height; ++row) {
    const std::uint8_t* from = image.pixels +
                               row_size * static_cast<std::size_t>(row + out.cropOriginY) +
                               pixel * static_cast<std::size_t>(first);
    std::uint8_t* to =
        static_cast<std::uint8_t*>(out.data) + static_cast<std::ptrdiff_t>(row) * out.stride;
    if (mirrored_ == FALSE) {
      std::memcpy(to, from, static_cast<std::size_t>(out.stride));
    } else if (sensor_ == ONI_SENSOR_DEPTH) {
      copy_reversed<2>(from, out.width, to);
    } else {
      copy_reversed<3>(from, out.width, to);
    }
  }
}

}  // namespace roomwise::simulator
