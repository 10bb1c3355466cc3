#pragma once
#include <vector>

#include "services/simulator/core/scene.h"

namespace roomwise::simulator {

/// The upright lines of a scene at rest, found from the plans of its solids taken together:
///   - crease convex: free space over 200 to 340 degrees around a corner. From where only one of
///   its two
///     faces shows, a detector calls it an edge (left or right) instead;
///   - crease concave: free over 20 to 160 degrees, as where two walls or a wardrobe and a wall
///   meet;
///   - pole, at its centre: a free-standing cylinder or block less than 0.25 m across.
/// Wider cylinders (limbs), panels and triangle meshes make none, nor does what is lower than 0.15
/// m. Each place appears once a kind, with the height span over which it holds that kind;
/// identities count from 0 in a fixed order. Cost: (corners of all plans)^2.
std::vector<SceneLandmark> true_landmarks(const Scene& scene);

}  // namespace roomwise::simulator
