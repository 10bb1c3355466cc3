#include "common/openni2/image_stream.h"

#include <OniCProperties.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "common/openni2/property_value.h"

namespace roomwise {
namespace {

constexpr int kMaxDepth_mm = 10000;

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

ImageStream::ImageStream(ImageStreamSettings settings)
    : settings_(std::move(settings)),
      mode_(settings_.modes.at(0)),
      mirrored_(settings_.mirrored ? TRUE : FALSE) {}

// The driver is told without our lock: it may be waiting to deliver to us.
OniStatus ImageStream::start() {
  {
    const std::lock_guard lock(mutex_);
    running_ = true;
  }
  if (settings_.start()) return ONI_STATUS_OK;
  const std::lock_guard lock(mutex_);
  running_ = false;
  return ONI_STATUS_ERROR;
}

void ImageStream::stop() {
  {
    const std::lock_guard lock(mutex_);
    if (!running_) return;
    running_ = false;
  }
  settings_.stop();
}

OniVideoMode ImageStream::mode() const {
  const std::lock_guard lock(mutex_);
  return mode_;
}

void ImageStream::set_registered(bool registered) {
  const std::lock_guard lock(mutex_);
  registered_ = registered;
}

OniStatus ImageStream::set_mode(const OniVideoMode& mode) {
  const bool is_offered = std::ranges::any_of(
      settings_.modes, [&](const OniVideoMode& candidate) { return candidate == mode; });
  if (!is_offered) return ONI_STATUS_NOT_SUPPORTED;
  if (mode == mode_) return ONI_STATUS_OK;
  if (running_) return ONI_STATUS_OUT_OF_FLOW;
  mode_ = mode;
  cropping_ = {};
  return ONI_STATUS_OK;
}

OniStatus ImageStream::set_cropping(const OniCropping& cropping) {
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

OniStatus ImageStream::setProperty(int id, const void* data, int size) {
  if (id == ONI_STREAM_PROPERTY_VIDEO_MODE) {
    OniVideoMode mode{};
    OniStatus status = take_value(data, size, mode);
    if (status == ONI_STATUS_OK) {
      const std::lock_guard lock(mutex_);
      status = set_mode(mode);
    }
    if (status == ONI_STATUS_OK) settings_.mode_changed();
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

OniStatus ImageStream::getProperty(int id, void* data, int* size) {
  const std::lock_guard lock(mutex_);
  if (isPropertySupported(id) == FALSE) return ONI_STATUS_NOT_SUPPORTED;
  switch (id) {
    case ONI_STREAM_PROPERTY_CROPPING:
      return give_value(cropping_, data, size);
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
      return give_value(settings_.horizontal_fov_rad, data, size);
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
      return give_value(settings_.vertical_fov_rad, data, size);
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return give_value(mode_, data, size);
    case ONI_STREAM_PROPERTY_MAX_VALUE:
      return give_value(settings_.sensor == ONI_SENSOR_DEPTH ? kMaxDepth_mm : 255, data, size);
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

OniBool ImageStream::isPropertySupported(int id) {
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
      return settings_.sensor == ONI_SENSOR_COLOR ? TRUE : FALSE;
    default:
      return FALSE;
  }
}

void ImageStream::notifyAllProperties() {
  for (int id = 0; id <= ONI_STREAM_PROPERTY_AUTO_EXPOSURE; ++id) {
    if (isPropertySupported(id) == FALSE) continue;
    std::array<std::uint8_t, sizeof(OniCropping)> value{};
    int size = property_size(id);
    getProperty(id, value.data(), &size);
    raisePropertyChanged(id, value.data(), size);
  }
}

OniStatus ImageStream::convertDepthToColorCoordinates(oni::driver::StreamBase* color, int depth_x,
                                                      int depth_y, OniDepthPixel /*depth_z*/,
                                                      int* color_x, int* color_y) {
  const std::lock_guard lock(mutex_);
  if (!registered_) return ONI_STATUS_NOT_SUPPORTED;
  const int color_width_px = static_cast<ImageStream*>(color)->mode().resolutionX;
  *color_x = depth_x * color_width_px / mode_.resolutionX;
  *color_y = depth_y * color_width_px / mode_.resolutionX;
  return ONI_STATUS_OK;
}

int ImageStream::stride() const {
  const int width_px = cropping_.enabled != FALSE ? cropping_.width : mode_.resolutionX;
  return width_px * bytes_per_pixel();
}

void ImageStream::deliver(const DriverImage& image) {
  const std::lock_guard lock(mutex_);
  if (!running_ || image.width_px != mode_.resolutionX || image.height_px != mode_.resolutionY) {
    return;
  }
  OniFrame* out = getServices().acquireFrame();
  if (out == nullptr) return;
  const bool cropped = cropping_.enabled != FALSE;
  out->sensorType = settings_.sensor;
  out->timestamp = static_cast<std::uint64_t>(image.time_us);
  out->frameIndex = static_cast<int>(image.number);
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

void ImageStream::copy_rows(const DriverImage& image, OniFrame& out) const {
  const auto pixel = static_cast<std::size_t>(bytes_per_pixel());
  const auto row_size = pixel * static_cast<std::size_t>(image.width_px);
  // A cropped rectangle is one of the image as delivered: mirrored first, if it is.
  const int first =
      mirrored_ != FALSE ? image.width_px - out.cropOriginX - out.width : out.cropOriginX;
  for (int row = 0; row < out.height; ++row) {
    const std::uint8_t* from = static_cast<const std::uint8_t*>(image.pixels) +
                               row_size * static_cast<std::size_t>(row + out.cropOriginY) +
                               pixel * static_cast<std::size_t>(first);
    std::uint8_t* to =
        static_cast<std::uint8_t*>(out.data) + static_cast<std::ptrdiff_t>(row) * out.stride;
    if (mirrored_ == FALSE) {
      std::memcpy(to, from, static_cast<std::size_t>(out.stride));
    } else if (settings_.sensor == ONI_SENSOR_DEPTH) {
      copy_reversed<2>(from, out.width, to);
    } else {
      copy_reversed<3>(from, out.width, to);
    }
  }
}

}  // namespace roomwise
