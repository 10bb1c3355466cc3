#pragma once
#include <vector>

#include "services/simulator/core/scene.h"

namespace roomwise::simulator {

/// The landmarks within 0.6 to 3.8 m and 28 degrees to either side of a robot at that pose, with
/// nothing in the plan between, judged at the middle of each landmark's height below 1 m.
std::vector<SceneLandmark> visible_landmarks(const Scene& scene, const Pose2& T_world_robot);

}  // namespace roomwise::simulator
