#pragma once
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "common/frames/frame_decoder.h"
#include "common/image/rgbd_frame.h"
#include "roomwise/kinect_frame_t.hpp"

namespace roomwise {

/// The colour images of the last frames as they came, still compressed: a person takes seconds to
/// draw rectangles on a frame, and few frames are ever drawn on. Their bytes go round in one block
/// of memory, taken whole with the first frame: frames of changing size in blocks of their own
/// would make the heap grow for an hour.
class ColorMemory {
 public:
  /// Keeps the newest frames whose colour data fit into `bytes_max` one after the other, at most
  /// 1000, and always one.
  explicit ColorMemory(std::size_t bytes_max) : bytes_max_(bytes_max) {}

  void keep(const kinect_frame_t& message);

  /// Decodes the colour of the frame taken at `utime`; false if it is not kept, has no colour, or
  /// its colour cannot be decoded.
  [[nodiscard]] bool recall(std::int64_t utime, ColorImage& color);

 private:
  struct Kept {
    kinect_frame_t frame;  ///< with neither depth nor the colour's data
    std::size_t begin;     ///< of its data in ring_
    std::size_t size;
    std::size_t end() const { return begin + size; }
  };

  std::size_t make_room(std::size_t size);

  std::size_t bytes_max_;
  std::vector<std::uint8_t> ring_;
  std::deque<Kept> kept_;  // oldest first
  FrameDecoder decoder_{ColorUse::kDecode};
  RgbdFrame frame_;
};

}  // namespace roomwise
