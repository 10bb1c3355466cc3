#include "services/segment_svc/color_memory.h"

#include <algorithm>

namespace roomwise {

void ColorMemory::keep(const kinect_frame_t& message) {
  if (message.color_encoding == kinect_frame_t::COLOR_NONE) return;
  kinect_frame_t& kept = frames_.emplace_back();
  kept.utime = message.utime;
  kept.color_encoding = message.color_encoding;
  kept.color_width_px = message.color_width_px;
  kept.color_height_px = message.color_height_px;
  kept.color_fx_px = message.color_fx_px;
  kept.color_fy_px = message.color_fy_px;
  kept.color_cx_px = message.color_cx_px;
  kept.color_cy_px = message.color_cy_px;
  kept.color_data = message.color_data;
  bytes_ += kept.color_data.size();
  while (frames_.size() > 1 && bytes_ > bytes_max_) forget_oldest();
}

void ColorMemory::forget_oldest() {
  bytes_ -= frames_.front().color_data.size();
  frames_.pop_front();
}

bool ColorMemory::recall(std::int64_t utime, ColorImage& color) {
  const auto kept = std::find_if(frames_.rbegin(), frames_.rend(),
                                 [&](const kinect_frame_t& frame) { return frame.utime == utime; });
  if (kept == frames_.rend() || decoder_.decode_color(*kept, frame_) != FrameResult::kOk) {
    return false;
  }
  color = frame_.color;
  return true;
}

}  // namespace roomwise
