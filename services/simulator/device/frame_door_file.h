#pragma once

namespace roomwise::simulator::door {

/// Marks `file` as served by this process until it closes it or dies. False if another has.
bool lock_file(int file);

/// True if some living process serves `file`.
bool is_locked(int file);

}  // namespace roomwise::simulator::door
