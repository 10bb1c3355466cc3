#pragma once
#include <vector>

#include "common/time.h"
#include "roomwise/truth_t.hpp"
#include "services/simulator/simulated_world.h"

namespace roomwise::simulator {

/// TRUTH of this moment, with the scene's landmarks if asked for.
truth_t truth_message(const SimulatedWorld& world, Time stamp, bool with_landmarks);

}  // namespace roomwise::simulator
