#include "services/kinect_pub/freenect/freenect_driver.h"

#include <chrono>
#include <exception>
#include <string_view>
#include <utility>

#include "services/kinect_pub/freenect/freenect_device.h"

namespace roomwise {
namespace {

constexpr std::string_view kScheme = "freenect://";
constexpr std::chrono::seconds kWatchPeriod{1};
/// How long OpenNI2's shutdown waits for the watcher, which may itself be waiting for a lock that
/// OpenNI2 holds while it shuts down.
constexpr std::chrono::seconds kShutdownPatience{2};

OniDeviceInfo info_of(const std::string& name) {
  OniDeviceInfo info{};
  const std::string uri = std::string(kScheme) + name;
  uri.copy(info.uri, sizeof info.uri - 1);
  std::string_view("Microsoft").copy(info.vendor, sizeof info.vendor - 1);
  std::string_view("Kinect").copy(info.name, sizeof info.name - 1);
  info.usbVendorId = 0x045e;
  info.usbProductId = 0x02ae;
  return info;
}

}  // namespace

FreenectDriver::FreenectDriver(OniDriverServices* services) : DriverBase(services) {}

FreenectDriver::~FreenectDriver() { shutdown(); }

OniStatus FreenectDriver::initialize(oni::driver::DeviceConnectedCallback connected,
                                     oni::driver::DeviceDisconnectedCallback disconnected,
                                     oni::driver::DeviceStateChangedCallback state_changed,
                                     void* cookie) {
  DriverBase::initialize(connected, disconnected, state_changed, cookie);
  look_at_bus();
  watcher_ended_ = false;
  watcher_ = std::thread([this] { watch(); });
  return ONI_STATUS_OK;
}

void FreenectDriver::shutdown() {
  std::unique_lock lock(mutex_);
  stopping_ = true;
  wake_.notify_all();
  if (!watcher_.joinable()) return;
  const bool ended = wake_.wait_for(lock, kShutdownPatience, [this] { return watcher_ended_; });
  lock.unlock();
  if (ended) {
    watcher_.join();
  } else {
    watcher_.detach();
  }
}

void FreenectDriver::watch() {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, kWatchPeriod, [this] { return stopping_; })) {
    lock.unlock();
    look_at_bus();
    lock.lock();
  }
  watcher_ended_ = true;
  wake_.notify_all();
}

void FreenectDriver::look_at_bus() {
  std::set<std::string> now;
  try {
    if (!context_) context_ = std::make_unique<FreenectContext>();
    for (const std::string& name : context_->devices()) now.insert(name);
  } catch (const std::exception& error) {  // no USB here, perhaps not yet
    getServices().log(0, __FILE__, __LINE__, "RoomwiseFreenect", error.what());
  }
  const std::set<std::string> before = std::exchange(present_, now);
  for (const std::string& name : before) {
    if (now.contains(name)) continue;
    const OniDeviceInfo info = info_of(name);
    deviceDisconnected(&info);
  }
  for (const std::string& name : now) {
    if (before.contains(name)) continue;
    const OniDeviceInfo info = info_of(name);
    deviceConnected(&info);
  }
}

OniStatus FreenectDriver::tryDevice(const char* /*uri*/) {
  return ONI_STATUS_NO_DEVICE;  // what is plugged in is listed
}

oni::driver::DeviceBase* FreenectDriver::deviceOpen(const char* uri, const char* /*mode*/) {
  try {
    return new FreenectDevice(std::string(std::string_view(uri).substr(kScheme.size())));
  } catch (const std::exception& error) {
    getServices().errorLoggerAppend("%s", error.what());
    return nullptr;
  }
}

void FreenectDriver::deviceClose(oni::driver::DeviceBase* device) { delete device; }

}  // namespace roomwise
