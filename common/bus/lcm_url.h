#pragma once
#include <cstdint>
#include <string>

namespace roomwise {

/// Where a live process listens when nobody says otherwise: the environment's LCM_DEFAULT_URL, else
/// LCM's usual multicast group, kept on this machine (ttl=0), with a receive buffer that holds some
/// camera frames or as much of it as the kernel allows.
std::string default_lcm_url();

/// The URL for a kernel that allows receive buffers of at most `rmem_max_bytes`.
std::string local_lcm_url(std::int64_t rmem_max_bytes);

}  // namespace roomwise
