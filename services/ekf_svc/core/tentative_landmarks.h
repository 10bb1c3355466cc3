#pragma once
#include <span>
#include <vector>

#include "services/ekf_svc/core/sighting.h"
#include "services/ekf_svc/core/slam_filter.h"

namespace roomwise::ekf {

/// Things seen that may be landmarks. Most false detections never come back; a real thing does, and
/// from elsewhere. They are in the filter from their first sighting on, so that what the robot does
/// until they are sure is measured by them; but nothing is corrected by them before, and they are
/// no part of the map.
class TentativeLandmarks {
 public:
  explicit TentativeLandmarks(SlamFilter& filter);

  /// A frame begins. What was not seen for 2 m of way is forgotten: landmark numbers change.
  void begin(double travel_m);

  /// The tentative landmark this sighting of nothing mapped is of, which is noted; `kNone`: of
  /// none. A frame sees each once.
  std::size_t find(const Sighting& sighting, const BodyObservation& seen);
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  /// Whether it was seen `times`, over 0.1 m or 5 degrees of motion.
  bool is_sure(std::size_t landmark, int times) const;

  /// Begins one. False if the budget is used up.
  bool begin_with(const BodyObservation& seen, const Landmark& landmark);

 private:
  static constexpr std::size_t kThingsMax = 256;
  struct Thing {
    std::size_t landmark;
    bool is_seen;  // in this frame
  };
  void collect();
  void forget_oldest(std::size_t left);

  SlamFilter* filter_;
  std::vector<Thing> things_;  // those there when the frame began
  std::size_t count_ = 0;      // and those begun since
  double travel_m_ = 0.0;
};

}  // namespace roomwise::ekf
