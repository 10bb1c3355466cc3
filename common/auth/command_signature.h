#pragma once
#include "common/auth/secret_key.h"
#include "roomwise/velocity_command_t.hpp"

namespace roomwise {

enum class Signature : std::uint8_t {
  kMissing,  ///< not signed
  kForged,   ///< signed, but not so by whoever has the key
  kGenuine,
};

/// Signs everything in `command` but `seq`, which the bus sets.
///
/// By crypto_auth (HMAC-SHA-512-256): both ends are this robot's own and read one file, so a shared
/// secret will do, and it is some forty times cheaper than a public key's signature.
void sign(const SecretKey& key, velocity_command_t& command);

Signature check_signature(const SecretKey& key, const velocity_command_t& command);

}  // namespace roomwise
