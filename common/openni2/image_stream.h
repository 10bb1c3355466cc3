#pragma once
#include <Driver/OniDriverAPI.h>

#include <cstdint>
#include <functional>
#include <mutex>
#include <vector>

namespace roomwise {

/// What an image stream of one of our OpenNI2 drivers is.
struct ImageStreamSettings {
  OniSensorType sensor = ONI_SENSOR_DEPTH;
  std::vector<OniVideoMode> modes;  ///< all it has; the first is in force at the start
  float horizontal_fov_rad = 1.0F;
  float vertical_fov_rad = 0.8F;
  bool mirrored = false;        ///< at the start
  std::function<bool()> start;  ///< called before the first image; false: it cannot
  std::function<void()> stop;   ///< called after the last
  std::function<void()> mode_changed;
};

/// One image as a driver has it, without gaps, not mirrored.
struct DriverImage {
  const void* pixels = nullptr;
  int width_px = 0;
  int height_px = 0;
  std::int64_t time_us = 0;  ///< device clock
  std::int64_t number = 0;   ///< the same for depth and colour of one instant
};

/// The side of a depth or colour stream that OpenNI2 sees: modes, mirroring, cropping, fields of
/// view, and images handed on as those say. A change of mode while it runs is refused
/// (ONI_STATUS_OUT_OF_FLOW); mirroring and cropping may change at any time.
class ImageStream : public oni::driver::StreamBase {
 public:
  explicit ImageStream(ImageStreamSettings settings);

  OniStatus start() override;
  void stop() override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniBool isPropertySupported(int id) override;
  void notifyAllProperties() override;
  OniStatus convertDepthToColorCoordinates(oni::driver::StreamBase* color, int depth_x, int depth_y,
                                           OniDepthPixel depth_z, int* color_x,
                                           int* color_y) override;

  /// Hands `image` on if the stream runs and the image is of the size in force. To be called
  /// without locks that a call from OpenNI2 may want.
  void deliver(const DriverImage& image);

  OniVideoMode mode() const;
  OniSensorType sensor() const { return settings_.sensor; }
  /// Whether depth pixels lie on the colour image's pixels, for convertDepthToColorCoordinates.
  void set_registered(bool registered);

 private:
  void copy_rows(const DriverImage& image, OniFrame& out) const;
  OniStatus set_mode(const OniVideoMode& mode);
  OniStatus set_cropping(const OniCropping& cropping);
  int bytes_per_pixel() const { return settings_.sensor == ONI_SENSOR_DEPTH ? 2 : 3; }
  int stride() const;

  const ImageStreamSettings settings_;
  mutable std::recursive_mutex mutex_;
  OniVideoMode mode_;
  OniCropping cropping_{};
  OniBool mirrored_;
  OniBool auto_white_balance_ = TRUE;
  OniBool auto_exposure_ = TRUE;
  bool registered_ = false;
  bool running_ = false;
};

}  // namespace roomwise
