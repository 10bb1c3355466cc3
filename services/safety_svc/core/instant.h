#pragma once
#include "common/time.h"

namespace roomwise::safety {

/// Now, by both clocks: ages run on the steady one, which nobody sets; stamps are of the other.
struct Instant {
  Duration steady{};  ///< since any fixed moment
  Time wall{};
};

}  // namespace roomwise::safety
