#include "services/kinect_pub/freenect/freenect_library.h"

#include <mutex>
#include <stdexcept>

namespace roomwise {
namespace {

std::mutex message_mutex;
std::string message;

void remember_message(freenect_context* /*context*/, freenect_loglevel level, const char* text) {
  if (level > FREENECT_LOG_ERROR) return;
  const std::lock_guard lock(message_mutex);
  message = text;
  message.erase(message.find_last_not_of(" \n") + 1);
}

/// Newer Kinects all say "0000000000000000".
bool is_serial(const std::string& text) { return text.find_first_not_of('0') != std::string::npos; }

}  // namespace

std::string last_freenect_message() {
  const std::lock_guard lock(message_mutex);
  return message;
}

bool freenect_is_whole() { return &freenect_list_device_attributes != nullptr; }

FreenectContext::FreenectContext() {
  if (freenect_init(&context_, nullptr) < 0) {
    throw std::runtime_error("libfreenect does not start: " + last_freenect_message());
  }
  freenect_set_log_callback(context_, remember_message);
  freenect_set_log_level(context_, FREENECT_LOG_ERROR);
  freenect_select_subdevices(
      context_, static_cast<freenect_device_flags>(FREENECT_DEVICE_MOTOR | FREENECT_DEVICE_CAMERA));
}

FreenectContext::~FreenectContext() { freenect_shutdown(context_); }

std::vector<std::string> FreenectContext::devices() const {
  std::vector<std::string> names;
  if (!freenect_is_whole()) {
    const int count = freenect_num_devices(context_);
    for (int i = 0; i < count; ++i) names.push_back(std::to_string(i));
    return names;
  }
  freenect_device_attributes* list = nullptr;
  freenect_list_device_attributes(context_, &list);
  for (const auto* device = list; device != nullptr; device = device->next) {
    const std::string serial = device->camera_serial == nullptr ? "" : device->camera_serial;
    names.push_back(is_serial(serial) ? serial : std::to_string(names.size()));
  }
  freenect_free_device_attributes(list);
  return names;
}

}  // namespace roomwise
