#pragma once
#include <Driver/OniDriverAPI.h>

#include <condition_variable>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace roomwise::simulator {

class FrameDoorReader;

/// OpenNI2 driver of the simulated Kinect: carries whole frames from a FrameDoor to OpenNI2's
/// streams and does nothing else.
///
/// URI: roomwise-sim://PATH of the door, e.g. roomwise-sim:///dev/shm/roomwise-0/kinect. The door
/// at default_frame_door() is listed whenever a simulator serves it; any other can be opened by its
/// URI, and is then watched as well: OpenNI2 hears when it goes and when it comes back.
class SimDriver : public oni::driver::DriverBase {
 public:
  explicit SimDriver(OniDriverServices* services);
  ~SimDriver() override;

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback state_changed,
                       void* cookie) override;
  oni::driver::DeviceBase* deviceOpen(const char* uri, const char* mode) override;
  void deviceClose(oni::driver::DeviceBase* device) override;
  void shutdown() override;
  OniStatus tryDevice(const char* uri) override;
  void* enableFrameSync(oni::driver::StreamBase** streams, int count) override;
  void disableFrameSync(void* group) override;

 private:
  struct Change {
    std::filesystem::path path;
    bool connected;
  };

  void watch();
  std::vector<Change> look_at_doors();
  void tell(const Change& change);
  bool start_watching(const std::filesystem::path& path);

  std::mutex telling_;  ///< held while OpenNI2 is told of a device
  std::mutex mutex_;    ///< of all that follows; never held while OpenNI2 is told
  std::condition_variable wake_;
  bool stopping_ = false;
  bool watcher_ended_ = true;
  /// Each door we know, and our hold on it while it is there.
  std::map<std::filesystem::path, std::unique_ptr<FrameDoorReader>> doors_;
  std::thread watcher_;
};

}  // namespace roomwise::simulator
