#pragma once

namespace roomwise {

/// Puts this process, and whatever it starts from now on, into a network of its own: a fresh
/// namespace with only `lo`, which carries multicast. No packet leaves it. Needs root or
/// unprivileged user namespaces; throws std::runtime_error saying which step the kernel refused.
/// To be called before the process starts a thread.
void enter_private_network();

}  // namespace roomwise
