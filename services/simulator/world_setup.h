#pragma once
#include "services/simulator/simulated_world.h"
#include "services/simulator/simulator_params.h"

namespace roomwise::simulator {

/// The world and the Create in it as the parameters have them. Throws std::runtime_error on a
/// scenario or fault that cannot be read.
SimulatedWorld world_of(const SimulatorParams& params);

/// True if something that happens so often happened in the step that ends `now`.
constexpr bool is_due(Duration now, std::int64_t rate_hz) {
  const auto count = [rate_hz](Duration t) { return t.count() * rate_hz / 1'000'000; };
  return count(now) != count(now - SimulatedCreate::kStep);
}

inline constexpr std::int64_t kTruthRate_hz = 60;
inline constexpr std::int64_t kLandmarkRate_hz = 1;
inline constexpr std::int64_t kCameraRate_hz = 30;

}  // namespace roomwise::simulator
