#pragma once

namespace roomwise {

/// Calls of operator new in this program since it started. Linking this replaces operator new.
long allocations_so_far();

}  // namespace roomwise
