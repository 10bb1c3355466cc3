#pragma once
#include <OpenNI.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <string>

namespace roomwise {

/// OpenNI2 itself, started once for the life of the process, and what it says of devices that come
/// and go.
class OpenNiLibrary : private openni::OpenNI::DeviceConnectedListener,
                      private openni::OpenNI::DeviceDisconnectedListener,
                      private openni::OpenNI::DeviceStateChangedListener {
 public:
  /// Loads the drivers. To be called before threads that use relative paths: meanwhile the
  /// process's working folder is the drivers'. Throws std::runtime_error with OpenNI2's words.
  OpenNiLibrary();
  OpenNiLibrary(const OpenNiLibrary&) = delete;
  OpenNiLibrary& operator=(const OpenNiLibrary&) = delete;
  ~OpenNiLibrary() override;

  /// "openni2 2.2.0.33".
  std::string version() const;

  /// How often the device of `uri` went away so far.
  std::int64_t losses(const std::string& uri) const;

  /// True if the recording of `uri` was played to its end since the last start_over().
  bool at_end(const std::string& uri) const;
  void start_over(const std::string& uri);

  /// Waits until a device appears, `patience` is over or wake() is called.
  void wait_for_device(std::chrono::milliseconds patience);
  void wake();

 private:
  void onDeviceConnected(const openni::DeviceInfo* info) override;
  void onDeviceDisconnected(const openni::DeviceInfo* info) override;
  void onDeviceStateChanged(const openni::DeviceInfo* info, openni::DeviceState state) override;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::int64_t wakes_ = 0;
  std::map<std::string, std::int64_t> losses_;
  std::set<std::string> at_end_;
};

}  // namespace roomwise
