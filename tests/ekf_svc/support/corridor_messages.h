#pragma once
#include <cstdint>

#include "common/channels.h"
#include "tests/ekf_svc/support/corridor_world.h"

namespace roomwise::ekf {

/// A drive through a CorridorWorld as the wheels and the detector would publish it, ten steps a
/// second.
class CorridorMessages {
 public:
  CorridorMessages(const CorridorWorld& world, std::int64_t start_utime)
      : world_(world), utime_(start_utime) {}

  odometry_t drive();
  landmark_list_t look();

  CorridorWorld& world() { return world_; }

 private:
  CorridorWorld world_;
  std::int64_t utime_;
  Pose2 T_odom_robot_;
};

}  // namespace roomwise::ekf
