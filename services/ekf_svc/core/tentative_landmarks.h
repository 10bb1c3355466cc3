#pragma once
#include <cstdint>
#include <vector>

#include "common/geometry/pose2.h"
#include "services/ekf_svc/core/sighting.h"

namespace roomwise::ekf {

/// Things seen that may be landmarks. Most false detections never come back; a real thing does, and
/// from elsewhere. Nothing here touches the filter.
class TentativeLandmarks {
 public:
  TentativeLandmarks() { things_.reserve(kThingsMax); }

  /// A frame begins, with the robot there.
  void begin(const Pose2& T_map_robot, double travel_m);

  /// Takes a sighting of nothing mapped. True if the thing has now been seen `times`, over 0.1 m or
  /// 5 degrees of motion: it is forgotten here and should be begun with this very sighting.
  bool confirms(const Sighting& sighting, const BodyObservation& seen, int times);

  void clear() { things_.clear(); }

 private:
  static constexpr std::size_t kThingsMax = 256;
  struct Thing {
    Eigen::Vector2d p_map_m;  // as last seen
    double variance_m2;
    std::int8_t kind;
    Pose2 first_seen_from;
    double last_seen_travel_m;
    int times_seen;
    std::int64_t frame;  // of the last sighting
  };
  Thing* nearest(const Sighting& sighting, const Eigen::Vector2d& p_map_m, double variance_m2);
  void remember(const Thing& thing);

  std::vector<Thing> things_;
  Pose2 T_map_robot_;
  double travel_m_ = 0.0;
  std::int64_t frame_ = 0;
};

}  // namespace roomwise::ekf
