#pragma once
#include <cstdint>
#include <map>
#include <vector>

#include "logs/tools/score_floor.h"
#include "roomwise/segmentation_t.hpp"

namespace roomwise {

class Bus;

/// Compares SEGMENTS with the simulator's TRUE_SEGMENTS, frame by frame.
class TrueFloor {
 public:
  /// Compares what `bus` will hand out. Label images that cannot be decoded are counted on the bus.
  void gather(Bus& bus);

  /// Of each frame that has both. Pixels whose true label is unknown are left out.
  const std::vector<FloorCounts>& frames() const { return frames_; }

 private:
  using ByFrame = std::map<std::int64_t, segmentation_t>;

  /// Compares the message with its counterpart in `others`, or keeps it in `own` until that comes.
  void meet(Bus& bus, const segmentation_t& message, ByFrame& own, ByFrame& others);
  void compare(Bus& bus, const segmentation_t& truth, const segmentation_t& said);

  ByFrame truth_;
  ByFrame said_;
  std::vector<FloorCounts> frames_;
};

}  // namespace roomwise
