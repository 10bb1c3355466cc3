#include "services/simulator/device/frame_door_reader.h"

#include <fcntl.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "services/simulator/device/frame_door_file.h"
#include "services/simulator/device/frame_door_layout.h"
#include "services/simulator/device/frame_door_words.h"

namespace roomwise::simulator {
namespace {

/// How soon a dead writer is noticed.
constexpr std::chrono::milliseconds kLongestSleep{100};

/// An open file that closes itself unless it is released.
class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& path)
      : path_(path), file_(::open(path.c_str(), O_RDWR | O_CLOEXEC)) {
    if (file_ < 0) refuse(std::strerror(errno));
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() {
    if (file_ >= 0) ::close(file_);
  }
  [[noreturn]] void refuse(const std::string& why) const {
    throw std::runtime_error("frame door " + path_.string() + ": " + why);
  }
  int get() const { return file_; }
  int release() { return std::exchange(file_, -1); }

 private:
  std::filesystem::path path_;
  int file_;
};

door::Layout* map(const OpenFile& file) {
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) file.refuse(std::strerror(errno));
  if (status.st_size != sizeof(door::Layout)) file.refuse("is no frame door of this version");
  if (!door::is_locked(file.get())) file.refuse("nobody serves it");
  void* memory =
      ::mmap(nullptr, sizeof(door::Layout), PROT_READ | PROT_WRITE, MAP_SHARED, file.get(), 0);
  if (memory == MAP_FAILED) file.refuse(std::strerror(errno));
  auto* layout = static_cast<door::Layout*>(memory);
  if (layout->header.magic != door::kMagic) {
    ::munmap(memory, sizeof(door::Layout));
    file.refuse("is no frame door of this version");
  }
  return layout;
}

PinholeCamera camera_of(const door::Camera& camera) {
  return {camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px};
}

}  // namespace

FrameDoorReader::FrameDoorReader(const std::filesystem::path& path) {
  OpenFile file(path);
  layout_ = map(file);
  file_ = file.release();
  const door::Header& header = layout_->header;
  serial_.assign(header.serial, ::strnlen(header.serial, door::kSerialSize));
  depth_camera_ = camera_of(header.depth_camera);
  color_camera_ = camera_of(header.color_camera);
  last_ = header.newest.load(std::memory_order_acquire);
}

FrameDoorReader::~FrameDoorReader() {
  ::munmap(layout_, sizeof(door::Layout));
  ::close(file_);
}

void FrameDoorReader::ask(const FrameRequest& request) {
  layout_->header.request.store(pack_request(request), std::memory_order_relaxed);
}

bool FrameDoorReader::is_served() const { return door::is_locked(file_); }

FrameDoorReader::Wait FrameDoorReader::next(DoorFrame& frame, std::chrono::milliseconds patience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (true) {
    layout_->header.looks.fetch_add(1, std::memory_order_relaxed);
    const std::uint32_t seen = layout_->header.wake.load(std::memory_order_acquire);
    if (copy_next(frame)) return Wait::kFrame;
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    if (!is_served()) return Wait::kGone;
    if (left.count() <= 0) return Wait::kNothing;
    sleep_until_woken(seen, std::min(left, kLongestSleep));
  }
}

bool FrameDoorReader::copy_next(DoorFrame& frame) {
  std::uint64_t newest = 0;
  while ((newest = layout_->header.newest.load(std::memory_order_acquire)) > last_) {
    // One slot may be under the writer's pen: of the others, the oldest not handed out yet.
    const std::uint64_t oldest = newest >= door::kSlots - 1 ? newest - (door::kSlots - 2) : 1;
    const std::uint64_t number = std::max(last_ + 1, oldest);
    missed_ += static_cast<std::int64_t>(number - last_ - 1);
    last_ = number;
    if (copy(number, frame)) return true;
    ++missed_;
  }
  return false;
}

bool FrameDoorReader::copy(std::uint64_t number, DoorFrame& frame) {
  door::Slot& slot = layout_->slots[number % door::kSlots];
  if (slot.state.load(std::memory_order_acquire) != 2 * number) return false;
  door::FrameFacts facts{};
  door::load_words(slot.facts, &facts, sizeof facts);
  if (!door::is_offered(facts.depth_width_px, facts.depth_height_px) ||
      !door::is_offered(facts.color_width_px, facts.color_height_px)) {
    return false;
  }
  frame.number = facts.number;
  frame.device_time_us = facts.device_time_us;
  frame.depth_registered = facts.depth_registered != 0;
  frame.depth_width_px = facts.depth_width_px;
  frame.depth_height_px = facts.depth_height_px;
  frame.color_width_px = facts.color_width_px;
  frame.color_height_px = facts.color_height_px;
  frame.depth_mm.resize(door::pixels(facts.depth_width_px, facts.depth_height_px));
  frame.rgb.resize(3 * door::pixels(facts.color_width_px, facts.color_height_px));
  door::load_words(slot.depth, frame.depth_mm.data(), 2 * frame.depth_mm.size());
  door::load_words(slot.color, frame.rgb.data(), frame.rgb.size());
  return slot.state.load(std::memory_order_relaxed) == 2 * number;
}

void FrameDoorReader::sleep_until_woken(std::uint32_t seen, std::chrono::milliseconds patience) {
  const timespec limit{.tv_sec = patience.count() / 1000,
                       .tv_nsec = (patience.count() % 1000) * 1'000'000};
  ::syscall(SYS_futex, reinterpret_cast<std::uint32_t*>(&layout_->header.wake), FUTEX_WAIT, seen,
            &limit, nullptr, 0);
}

}  // namespace roomwise::simulator
