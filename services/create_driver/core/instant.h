#pragma once
#include "common/time.h"

namespace roomwise::create {

/// Now, by both clocks: deadlines run on the steady one, which nobody sets; what is measured or
/// decided is dated by the other.
struct Instant {
  Duration steady{};  ///< since any fixed moment
  Time wall{};
};

}  // namespace roomwise::create
