#pragma once
#include <Driver/OniDriverAPI.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "common/openni2/image_stream.h"
#include "services/simulator/device/frame_door_reader.h"

namespace roomwise::simulator {

/// One opened simulated camera. A thread carries frames from its door to its streams; a frame that
/// is not of the size or registration asked for was made before the simulator heard of it, and is
/// left out. When the simulator goes, frames end for good: the client opens the device anew.
class SimDevice : public oni::driver::DeviceBase {
 public:
  /// Throws std::runtime_error if nobody serves the door.
  explicit SimDevice(const std::filesystem::path& path);
  ~SimDevice() override;

  OniStatus getSensorInfoList(OniSensorInfo** sensors, int* count) override;
  oni::driver::StreamBase* createStream(OniSensorType sensor) override;
  void destroyStream(oni::driver::StreamBase* stream) override;
  OniStatus setProperty(int id, const void* data, int size) override;
  OniStatus getProperty(int id, void* data, int* size) override;
  OniBool isPropertySupported(int id) override;
  OniBool isImageRegistrationModeSupported(OniImageRegistrationMode mode) override;

 private:
  void carry_frames();
  void deliver(const DoorFrame& frame);
  void ask_for_frames();
  ImageStreamSettings settings_of(OniSensorType sensor);

  FrameDoorReader reader_;
  std::mutex mutex_;  ///< never held while a frame is handed to OpenNI2, which has locks of its own
  std::vector<std::shared_ptr<ImageStream>> streams_;
  bool registered_ = false;
  std::atomic<bool> stopping_{false};
  std::thread carrier_;
};

}  // namespace roomwise::simulator
