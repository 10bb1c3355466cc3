#pragma once
#include <cstdint>
#include <deque>

#include "common/frames/frame_decoder.h"
#include "common/image/rgbd_frame.h"
#include "roomwise/kinect_frame_t.hpp"

namespace roomwise {

/// The colour images of the last frames as they came, still compressed: a person takes seconds to
/// draw rectangles on a frame, and few frames are ever drawn on.
class ColorMemory {
 public:
  /// Keeps the newest frames whose colour data fit into `bytes_max` together, and always one.
  explicit ColorMemory(std::size_t bytes_max) : bytes_max_(bytes_max) {}

  void keep(const kinect_frame_t& message);

  /// Decodes the colour of the frame taken at `utime`; false if it is not kept, has no colour, or
  /// its colour cannot be decoded.
  [[nodiscard]] bool recall(std::int64_t utime, ColorImage& color);

 private:
  void forget_oldest();

  std::size_t bytes_max_;
  std::size_t bytes_ = 0;
  std::deque<kinect_frame_t> frames_;  // without depth, oldest first
  FrameDecoder decoder_{ColorUse::kDecode};
  RgbdFrame frame_;
};

}  // namespace roomwise
