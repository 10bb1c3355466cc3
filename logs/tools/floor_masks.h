#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "logs/tools/score_floor.h"
#include "roomwise/segmentation_t.hpp"

namespace roomwise {

class Bus;

/// Compares SEGMENTS with masks of the true floor, frame by frame.
class FloorMasks {
 public:
  /// Looks for frame-N.floor.png in `folder`. N is KINECT_FRAME.seq - 1, as import makes it. Throws
  /// std::runtime_error naming the folder if it holds none.
  explicit FloorMasks(const std::filesystem::path& folder);

  /// Compares what `bus` will hand out. Label images that cannot be decoded are counted on the bus.
  void gather(Bus& bus);

  /// Of each frame that has labels and a mask.
  const std::vector<FloorCounts>& frames() const { return frames_; }

 private:
  void compare(Bus& bus, const segmentation_t& message);

  std::map<std::int64_t, std::filesystem::path> mask_of_frame_seq_;
  std::vector<FloorCounts> frames_;
};

}  // namespace roomwise
