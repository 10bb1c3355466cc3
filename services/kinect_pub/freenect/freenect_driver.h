#pragma once
#include <Driver/OniDriverAPI.h>

#include <condition_variable>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "services/kinect_pub/freenect/freenect_library.h"

namespace roomwise {

/// OpenNI2 driver of the Kinect v1 (the Xbox 360 one), on libfreenect. URI: freenect://SERIAL, or
/// freenect://INDEX where the device has no serial number. Looks once a second which are plugged
/// in.
class FreenectDriver : public oni::driver::DriverBase {
 public:
  explicit FreenectDriver(OniDriverServices* services);
  ~FreenectDriver() override;

  OniStatus initialize(oni::driver::DeviceConnectedCallback connected,
                       oni::driver::DeviceDisconnectedCallback disconnected,
                       oni::driver::DeviceStateChangedCallback state_changed,
                       void* cookie) override;
  oni::driver::DeviceBase* deviceOpen(const char* uri, const char* mode) override;
  void deviceClose(oni::driver::DeviceBase* device) override;
  void shutdown() override;
  OniStatus tryDevice(const char* uri) override;

 private:
  void watch();
  void look_at_bus();

  std::mutex mutex_;
  std::condition_variable wake_;
  bool stopping_ = false;
  bool watcher_ended_ = true;
  std::unique_ptr<FreenectContext> context_;  ///< the watcher's
  std::set<std::string> present_;             ///< the watcher's
  std::thread watcher_;
};

}  // namespace roomwise
