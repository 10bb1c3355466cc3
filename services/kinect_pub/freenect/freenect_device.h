#pragma once
#include <Driver/OniDriverAPI.h>
#include <libfreenect.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "common/openni2/image_stream.h"
#include "services/kinect_pub/core/shift_depth.h"
#include "services/kinect_pub/core/tick_clock.h"
#include "services/kinect_pub/freenect/freenect_library.h"

namespace roomwise {

/// One opened Kinect v1: depth (DEPTH_1_MM, or SHIFT_9_2 for the sensor's own 11-bit words; both
/// 640 x 480, or every second pixel of it) and colour (RGB888), registration by libfreenect, tilt
/// and accelerometer (FreenectProperty).
///
/// Depth that is not registered is converted here, by the equation of shift_table with the device's
/// own constants. A thread serves libfreenect's events and, when that fails because the device was
/// pulled out, goes silent for good.
class FreenectDevice : public oni::driver::DeviceBase {
 public:
  /// `name`: as FreenectContext::devices() has it. Throws std::runtime_error with the reason.
  explicit FreenectDevice(const std::string& name);
  ~FreenectDevice() override;

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override;
  oni::driver::StreamBase* createStream(OniSensorType sensor) override;
  void destroyStream(oni::driver::StreamBase* stream) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniBool isPropertySupported(int id) override;
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override;

  /// True once the device answers no more.
  bool is_gone() const { return gone_; }

 private:
  using Streams = std::vector<std::shared_ptr<ImageStream>>;

  static void on_depth(freenect_device* device, void* pixels, std::uint32_t ticks);
  static void on_color(freenect_device* device, void* pixels, std::uint32_t ticks);
  void serve_events();
  void deliver_depth(const std::uint16_t* words, std::uint32_t ticks);
  void deliver_color(const std::uint8_t* rgb, std::uint32_t ticks);
  bool start_depth();
  bool start_color();
  void stop(OniSensorType sensor);
  ImageStreamSettings settings_of(OniSensorType sensor);
  Streams streams_of(OniSensorType sensor);
  OniStatus set_registration(const void* data, int size);
  OniStatus set_tilt(const void* data, int size);
  OniStatus give_acceleration(void* data, int* size);

  const std::string name_;
  FreenectContext context_;
  freenect_device* device_ = nullptr;
  kinect::ShiftTable table_{};
  kinect::TickClock clock_;
  std::mutex mutex_;  ///< never held while an image is handed to OpenNI2
  Streams streams_;
  std::atomic<bool> registered_{false};
  bool depth_runs_ = false;
  std::vector<std::uint16_t> depth_;
  std::vector<std::uint16_t> small_depth_;
  std::vector<std::uint8_t> small_color_;
  std::atomic<bool> stopping_{false};
  std::atomic<bool> gone_{false};
  std::thread server_;
};

}  // namespace roomwise
