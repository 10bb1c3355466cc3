#include "services/segment_svc/color_memory.h"

#include <algorithm>

namespace roomwise {
namespace {

constexpr std::size_t kFramesMax = 1000;  // of next to no data each, from whoever sends such

}  // namespace

void ColorMemory::keep(const kinect_frame_t& message) {
  if (message.color_encoding == kinect_frame_t::COLOR_NONE || message.color_data.empty()) return;
  if (kept_.size() == kFramesMax) kept_.pop_front();
  const std::size_t size = message.color_data.size();
  const std::size_t begin = make_room(size);
  std::copy(message.color_data.begin(), message.color_data.end(),
            ring_.begin() + static_cast<std::ptrdiff_t>(begin));
  Kept& kept = kept_.emplace_back();
  kept.begin = begin;
  kept.size = size;
  kept.frame.utime = message.utime;
  kept.frame.color_encoding = message.color_encoding;
  kept.frame.color_width_px = message.color_width_px;
  kept.frame.color_height_px = message.color_height_px;
  kept.frame.color_fx_px = message.color_fx_px;
  kept.frame.color_fy_px = message.color_fy_px;
  kept.frame.color_cx_px = message.color_cx_px;
  kept.frame.color_cy_px = message.color_cy_px;
}

/// Forgets the oldest frames that are in the way of `size` bytes behind the newest, and returns
/// where those bytes begin.
std::size_t ColorMemory::make_room(std::size_t size) {
  if (ring_.size() < std::max(size, bytes_max_)) {
    kept_.clear();
    ring_.assign(std::max(size, bytes_max_), 0);
  }
  std::size_t begin = kept_.empty() ? 0 : kept_.back().end();
  if (begin + size > ring_.size()) {
    // What lies from here to the end of the block is older than all at its beginning.
    while (!kept_.empty() && kept_.front().begin >= begin) kept_.pop_front();
    begin = 0;
  }
  const auto is_in_the_way = [&](const Kept& kept) {
    return kept.begin < begin + size && begin < kept.end();
  };
  while (!kept_.empty() && is_in_the_way(kept_.front())) kept_.pop_front();
  return begin;
}

bool ColorMemory::recall(std::int64_t utime, ColorImage& color) {
  const auto kept = std::find_if(kept_.rbegin(), kept_.rend(),
                                 [&](const Kept& each) { return each.frame.utime == utime; });
  if (kept == kept_.rend()) return false;
  kinect_frame_t message = kept->frame;
  const auto data = ring_.begin() + static_cast<std::ptrdiff_t>(kept->begin);
  message.color_data.assign(data, data + static_cast<std::ptrdiff_t>(kept->size));
  message.color_size = static_cast<std::int32_t>(kept->size);
  if (decoder_.decode_color(message, frame_) != FrameResult::kOk) return false;
  color = frame_.color;
  return true;
}

}  // namespace roomwise
