#include "services/kinect_pub/device/openni_library.h"

#include <stdexcept>

#include "common/openni2/openni_error.h"

namespace roomwise {

using openni::OpenNI;

OpenNiLibrary::OpenNiLibrary() {
  if (OpenNI::initialize() != openni::STATUS_OK) {
    throw std::runtime_error("OpenNI2 does not start: " + openni_error());
  }
  OpenNI::addDeviceConnectedListener(this);
  OpenNI::addDeviceDisconnectedListener(this);
  OpenNI::addDeviceStateChangedListener(this);
}

OpenNiLibrary::~OpenNiLibrary() {
  OpenNI::removeDeviceConnectedListener(this);
  OpenNI::removeDeviceDisconnectedListener(this);
  OpenNI::removeDeviceStateChangedListener(this);
  // No OpenNI::shutdown(): it holds OpenNI2's lock while it waits for drivers, and a driver's
  // thread that reports a device gone at that moment waits for that lock. The process ends anyway.
}

std::string OpenNiLibrary::version() const {
  const openni::Version version = OpenNI::getVersion();
  return "openni2 " + std::to_string(version.major) + "." + std::to_string(version.minor) + "." +
         std::to_string(version.maintenance) + "." + std::to_string(version.build);
}

std::int64_t OpenNiLibrary::losses(const std::string& uri) const {
  const std::lock_guard lock(mutex_);
  const auto found = losses_.find(uri);
  return found == losses_.end() ? 0 : found->second;
}

bool OpenNiLibrary::at_end(const std::string& uri) const {
  const std::lock_guard lock(mutex_);
  return at_end_.contains(uri);
}

void OpenNiLibrary::start_over(const std::string& uri) {
  const std::lock_guard lock(mutex_);
  at_end_.erase(uri);
}

void OpenNiLibrary::wait_for_device(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  const std::int64_t wakes = wakes_;
  changed_.wait_for(lock, patience, [&] { return wakes_ != wakes; });
}

void OpenNiLibrary::wake() {
  {
    const std::lock_guard lock(mutex_);
    ++wakes_;
  }
  changed_.notify_all();
}

void OpenNiLibrary::onDeviceConnected(const openni::DeviceInfo* /*info*/) { wake(); }

void OpenNiLibrary::onDeviceDisconnected(const openni::DeviceInfo* info) {
  const std::lock_guard lock(mutex_);
  ++losses_[info->getUri()];
}

void OpenNiLibrary::onDeviceStateChanged(const openni::DeviceInfo* info,
                                         openni::DeviceState state) {
  const std::lock_guard lock(mutex_);
  if (state == openni::DEVICE_STATE_EOF) at_end_.insert(info->getUri());
}

}  // namespace roomwise
