#pragma once
#include <Driver/OniDriverAPI.h>

#include <array>
#include <functional>
#include <mutex>

#include "common/image/rgbd_frame.h"
#include "services/simulator/device/frame_door_reader.h"

namespace roomwise::simulator {

/// One image stream of the simulated camera: DEPTH_1_MM or RGB888, 640 x 480 or 320 x 240 at 30 Hz.
/// Mirrored at first, as the cameras it stands in for are. A change of mode while it runs is
/// refused (ONI_STATUS_OUT_OF_FLOW); mirroring and cropping may change at any time.
class SimStream : public oni::driver::StreamBase {
 public:
  /// `camera`: of the 640 x 480 image. `mode_changed` is called after every change of mode.
  SimStream(OniSensorType sensor, const PinholeCamera& camera, std::function<void()> mode_changed);

  OniStatus start() override;
  void stop() override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniBool isPropertySupported(int id) override;
  void notifyAllProperties() override;
  OniStatus convertDepthToColorCoordinates(oni::driver::StreamBase* color, int depth_x, int depth_y,
                                           OniDepthPixel depth_z, int* color_x,
                                           int* color_y) override;

  /// Hands `frame`'s image on if the stream runs and the image is of its size.
  void deliver(const DoorFrame& frame);

  int width_px() const;
  OniSensorType sensor() const { return sensor_; }
  void set_registered(bool registered);

  /// What getSensorInfoList says of a sensor.
  static OniSensorInfo describe(OniSensorType sensor);

 private:
  struct Image {
    const std::uint8_t* pixels;
    int width_px;
    int height_px;
  };
  Image image_in(const DoorFrame& frame) const;
  void copy_rows(const Image& image, OniFrame& out) const;
  OniStatus set_mode(const OniVideoMode& mode);
  OniStatus set_cropping(const OniCropping& cropping);
  int bytes_per_pixel() const { return sensor_ == ONI_SENSOR_DEPTH ? 2 : 3; }
  int stride() const;
  float field_of_view_rad(int id) const;

  const OniSensorType sensor_;
  const PinholeCamera camera_;
  const std::function<void()> mode_changed_;
  mutable std::recursive_mutex mutex_;
  OniVideoMode mode_;
  OniCropping cropping_{};
  OniBool mirrored_ = TRUE;
  OniBool auto_white_balance_ = TRUE;
  OniBool auto_exposure_ = TRUE;
  bool registered_ = false;
  bool running_ = false;
};

}  // namespace roomwise::simulator
