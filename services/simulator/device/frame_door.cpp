#include "services/simulator/device/frame_door.h"

#include <fcntl.h>
#include <linux/futex.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "services/simulator/device/frame_door_file.h"
#include "services/simulator/device/frame_door_layout.h"
#include "services/simulator/device/frame_door_words.h"

namespace roomwise::simulator {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw std::runtime_error("frame door " + path.string() + ": " + why);
}

[[noreturn]] void refuse_with_errno(const std::filesystem::path& path) {
  refuse(path, std::strerror(errno));
}

/// Holds a folder's lock, so that two doors are not made in it at the same time.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder)
      : file_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (file_ < 0 || ::flock(file_, LOCK_EX) != 0) refuse_with_errno(folder);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock() { ::close(file_); }

 private:
  int file_;
};

void remove_what_nobody_serves(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0 && errno == ENOENT) return;
  if (file < 0) refuse_with_errno(path);
  const bool served = door::is_locked(file);
  ::close(file);
  if (served) refuse(path, "another process serves it");
  ::unlink(path.c_str());
}

/// A new file of the right size, locked.
int new_file(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_CREAT | O_TRUNC | O_RDWR | O_CLOEXEC, 0600);
  if (file < 0) refuse_with_errno(path);
  const int full = ::posix_fallocate(file, 0, sizeof(door::Layout));
  if (full != 0) refuse(path, std::strerror(full));
  if (!door::lock_file(file)) refuse_with_errno(path);
  return file;
}

door::Camera stored(const PinholeCamera& camera) {
  return {camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px};
}

void describe(const FrameDoorDescription& description, door::Header& header) {
  header.file_size = sizeof(door::Layout);
  description.serial.copy(header.serial, door::kSerialSize - 1);
  header.depth_camera = stored(description.depth_camera);
  header.color_camera = stored(description.color_camera);
  header.magic = door::kMagic;
}

void check(const RgbdFrame& frame) {
  if (!door::is_offered(frame.depth.width_px, frame.depth.height_px) ||
      !door::is_offered(frame.color.width_px, frame.color.height_px)) {
    throw std::invalid_argument("frame door: images must be 640 x 480 or 320 x 240");
  }
  if (frame.depth.steps.size() != door::pixels(frame.depth.width_px, frame.depth.height_px) ||
      frame.color.rgb.size() != 3 * door::pixels(frame.color.width_px, frame.color.height_px)) {
    throw std::invalid_argument("frame door: image size does not match its pixels");
  }
}

void wake_readers(std::atomic<std::uint32_t>& wake) {
  ::syscall(SYS_futex, reinterpret_cast<std::uint32_t*>(&wake), FUTEX_WAKE, INT_MAX, nullptr,
            nullptr, 0);
}

door::Layout& layout_in(void* memory) { return *static_cast<door::Layout*>(memory); }

}  // namespace

std::filesystem::path default_frame_door() {
  if (const char* path = std::getenv("ROOMWISE_SIM_KINECT"); path != nullptr && *path != '\0') {
    return path;
  }
  return "/dev/shm/roomwise-" + std::to_string(::getuid()) + "/kinect";
}

FrameDoor::FrameDoor(const std::filesystem::path& path, const FrameDoorDescription& description)
    : path_(std::filesystem::absolute(path)) {
  const std::filesystem::path folder = path_.parent_path();
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) refuse(path_, failed.message());
  const FolderLock lock(folder);
  remove_what_nobody_serves(path_);
  const std::string part = path_.string() + ".part";
  file_ = new_file(part);
  memory_ = ::mmap(nullptr, sizeof(door::Layout), PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0);
  if (memory_ == MAP_FAILED) refuse_with_errno(path_);
  describe(description, layout_in(memory_).header);
  if (::rename(part.c_str(), path_.c_str()) != 0) refuse_with_errno(path_);
}

FrameDoor::~FrameDoor() {
  ::unlink(path_.c_str());
  ::munmap(memory_, sizeof(door::Layout));
  ::close(file_);
}

void FrameDoor::write(const RgbdFrame& frame, std::int64_t device_time_us) {
  check(frame);
  const door::FrameFacts facts{.number = ++frames_,
                               .device_time_us = device_time_us,
                               .depth_width_px = frame.depth.width_px,
                               .depth_height_px = frame.depth.height_px,
                               .color_width_px = frame.color.width_px,
                               .color_height_px = frame.color.height_px,
                               .depth_registered = frame.depth_registered ? 1 : 0};
  const auto number = static_cast<std::uint64_t>(frames_);
  door::Layout& layout = layout_in(memory_);
  door::Slot& slot = layout.slots[number % door::kSlots];
  slot.state.store(2 * number - 1, std::memory_order_relaxed);
  door::store_words(slot.facts, &facts, sizeof facts);
  door::store_words(slot.depth, frame.depth.steps.data(), 2 * frame.depth.steps.size());
  door::store_words(slot.color, frame.color.rgb.data(), frame.color.rgb.size());
  slot.state.store(2 * number, std::memory_order_release);
  layout.header.newest.store(number, std::memory_order_release);
  layout.header.wake.fetch_add(1, std::memory_order_release);
  wake_readers(layout.header.wake);
}

FrameRequest FrameDoor::request() const {
  return unpack_request(layout_in(memory_).header.request.load(std::memory_order_relaxed));
}

std::uint64_t FrameDoor::looks() const {
  return layout_in(memory_).header.looks.load(std::memory_order_relaxed);
}

}  // namespace roomwise::simulator
