#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace roomwise::simulator::door {

// What lies in the file both ends of a frame door map: a Header, then kSlots Slots. Everything the
// two ends touch at the same time is a lock-free atomic.

inline constexpr std::uint64_t kMagic = 0x32'30'52'4f'4f'44'57'52;  ///< "RWDOOR02"
inline constexpr int kLargestWidth_px = 640;
inline constexpr int kLargestHeight_px = 480;
inline constexpr std::size_t kPixels = std::size_t{kLargestWidth_px} * kLargestHeight_px;
inline constexpr std::size_t kSlots = 4;  ///< a reader may fall 3 frames behind and lose none
inline constexpr std::size_t kSerialSize = 32;

/// The image sizes a door carries.
constexpr bool is_offered(int width_px, int height_px) {
  return (width_px == 640 && height_px == 480) || (width_px == 320 && height_px == 240);
}

constexpr std::size_t pixels(int width_px, int height_px) {
  return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
}

/// Pinhole camera of the 640 x 480 image.
struct Camera {
  double fx_px;
  double fy_px;
  double cx_px;
  double cy_px;
};

/// What a slot's frame is, beside its pixels. Whole 8-byte words.
struct FrameFacts {
  std::int64_t number;  ///< from 1
  std::int64_t device_time_us;
  std::int32_t depth_width_px;
  std::int32_t depth_height_px;
  std::int32_t color_width_px;
  std::int32_t color_height_px;
  std::int64_t depth_registered;
};
static_assert(sizeof(FrameFacts) % 8 == 0);

inline constexpr std::size_t kFactWords = sizeof(FrameFacts) / 8;
inline constexpr std::size_t kDepthWords = kPixels * 2 / 8;
inline constexpr std::size_t kColorWords = kPixels * 3 / 8;

/// One frame. `state` is 2 n - 1 while frame n is being written and 2 n once it is whole: a reader
/// that finds 2 n before and after copying has all of frame n and nothing else.
struct Slot {
  std::atomic<std::uint64_t> state;
  std::uint64_t facts[kFactWords];
  std::uint64_t depth[kDepthWords];  ///< uint16 millimetres, row by row
  std::uint64_t color[kColorWords];  ///< red green blue, row by row
};

struct Header {
  std::uint64_t magic;
  std::uint64_t file_size;
  char serial[kSerialSize];
  Camera depth_camera;
  Camera color_camera;
  std::atomic<std::uint64_t> request;  ///< written by the reader: see pack_request
  std::atomic<std::uint64_t> looks;    ///< grows while any reader waits for a frame
  std::atomic<std::uint64_t> newest;   ///< number of the newest whole frame; 0: none yet
  std::atomic<std::uint32_t> wake;     ///< futex: changes with every frame
};

struct Layout {
  Header header;
  alignas(64) Slot slots[kSlots];
};

static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
static_assert(std::atomic<std::uint32_t>::is_always_lock_free);

}  // namespace roomwise::simulator::door
