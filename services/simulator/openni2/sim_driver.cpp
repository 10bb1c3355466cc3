#include "services/simulator/openni2/sim_driver.h"

#include <chrono>
#include <exception>
#include <optional>
#include <string_view>

#include "services/simulator/device/frame_door.h"
#include "services/simulator/device/frame_door_reader.h"
#include "services/simulator/openni2/sim_device.h"

namespace roomwise::simulator {
namespace {

constexpr std::string_view kScheme = "roomwise-sim://";
constexpr std::chrono::milliseconds kWatchPeriod{100};
/// How long OpenNI2's shutdown waits for the watcher, which may itself be waiting for a lock that
/// OpenNI2 holds while it shuts down.
constexpr std::chrono::seconds kShutdownPatience{1};

std::optional<std::filesystem::path> path_of(std::string_view uri) {
  if (!uri.starts_with(kScheme)) return std::nullopt;
  return std::filesystem::path(uri.substr(kScheme.size()));
}

OniDeviceInfo info_of(const std::filesystem::path& path) {
  OniDeviceInfo info{};
  const std::string uri = std::string(kScheme) + path.string();
  uri.copy(info.uri, sizeof info.uri - 1);
  std::string_view("Roomwise").copy(info.vendor, sizeof info.vendor - 1);
  std::string_view("Simulated Kinect").copy(info.name, sizeof info.name - 1);
  return info;
}

std::unique_ptr<FrameDoorReader> open_if_served(const std::filesystem::path& path) {
  try {
    return std::make_unique<FrameDoorReader>(path);
  } catch (const std::exception&) {
    return nullptr;  // nothing there, or not yet
  }
}

}  // namespace

SimDriver::SimDriver(OniDriverServices* services) : DriverBase(services) {}

SimDriver::~SimDriver() { shutdown(); }

OniStatus SimDriver::initialize(oni::driver::DeviceConnectedCallback connected,
                                oni::driver::DeviceDisconnectedCallback disconnected,
                                oni::driver::DeviceStateChangedCallback state_changed,
                                void* cookie) {
  DriverBase::initialize(connected, disconnected, state_changed, cookie);
  doors_[default_frame_door()] = nullptr;
  for (const Change& change : look_at_doors()) tell(change);
  watcher_ended_ = false;
  watcher_ = std::thread([this] { watch(); });
  return ONI_STATUS_OK;
}

void SimDriver::shutdown() {
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

void SimDriver::watch() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    lock.unlock();
    const std::vector<Change> changes = look_at_doors();
    for (const Change& change : changes) {
      const std::lock_guard telling(telling_);
      tell(change);
    }
    lock.lock();
    wake_.wait_for(lock, kWatchPeriod, [this] { return stopping_; });
  }
  watcher_ended_ = true;
  wake_.notify_all();
}

std::vector<SimDriver::Change> SimDriver::look_at_doors() {
  const std::lock_guard lock(mutex_);
  std::vector<Change> changes;
  if (stopping_) return changes;
  for (auto& [path, reader] : doors_) {
    if (reader && !reader->is_served()) {
      reader = nullptr;
      changes.push_back({path, false});
    }
    if (!reader && (reader = open_if_served(path))) changes.push_back({path, true});
  }
  return changes;
}

void SimDriver::tell(const Change& change) {
  const OniDeviceInfo info = info_of(change.path);
  if (change.connected) {
    deviceConnected(&info);
  } else {
    deviceDisconnected(&info);
  }
}

bool SimDriver::start_watching(const std::filesystem::path& path) {
  const std::lock_guard lock(mutex_);
  std::unique_ptr<FrameDoorReader>& reader = doors_[path];
  if (reader) return false;
  reader = std::make_unique<FrameDoorReader>(path);
  return true;
}

OniStatus SimDriver::tryDevice(const char* uri) {
  const auto path = path_of(uri);
  if (!path) return ONI_STATUS_ERROR;
  // OpenNI2 holds a lock now that the watcher, telling it of a device, may be waiting for while it
  // holds another that we would need: then the client has to ask again.
  const std::unique_lock telling(telling_, std::try_to_lock);
  if (!telling.owns_lock()) return ONI_STATUS_ERROR;
  try {
    if (start_watching(*path)) tell({*path, true});
    return ONI_STATUS_OK;
  } catch (const std::exception& error) {
    getServices().errorLoggerAppend("%s", error.what());
    return ONI_STATUS_NO_DEVICE;
  }
}

oni::driver::DeviceBase* SimDriver::deviceOpen(const char* uri, const char* /*mode*/) {
  try {
    return new SimDevice(path_of(uri).value());
  } catch (const std::exception& error) {
    getServices().errorLoggerAppend("%s", error.what());
    return nullptr;
  }
}

void SimDriver::deviceClose(oni::driver::DeviceBase* device) { delete device; }

// Both streams of a frame carry the frame's number, which is what OpenNI2 pairs them by.
void* SimDriver::enableFrameSync(oni::driver::StreamBase** /*streams*/, int /*count*/) {
  return this;
}

void SimDriver::disableFrameSync(void* /*group*/) {}

}  // namespace roomwise::simulator
