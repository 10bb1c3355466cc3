#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/geometry/pose2.h"

namespace roomwise {

/// A pose and when it was.
struct TimedPose2 {
  std::int64_t utime = 0;
  Pose2 pose;
};

/// In order of time.
using Trajectory = std::vector<TimedPose2>;

/// The pose at `utime`, between the two neighbours (heading the short way round). None outside the
/// trajectory, or if the neighbours are more than a second apart.
std::optional<Pose2> pose_at(const Trajectory& trajectory, std::int64_t utime);

/// The first pose at or after each of `utimes`, which are in order; each pose once.
Trajectory first_after(const Trajectory& trajectory, std::span<const std::int64_t> utimes);

}  // namespace roomwise
