#pragma once
#include <array>
#include <cstdint>
#include <filesystem>

namespace roomwise {

/// What safety_svc and create_driver share and nobody else may know.
using SecretKey = std::array<std::uint8_t, 32>;

/// Where the key lies unless a parameter says otherwise: drive.key in /tmp/roomwise-UID.
std::filesystem::path default_key_path();

/// Draws a new key and puts it at `path` (empty: the default) in one step, readable by its owner
/// alone (0600); its folder is made (0700) if need be. Throws std::runtime_error naming the path if
/// that cannot be done, or if the folder belongs to or can be written by somebody else.
SecretKey make_key_file(const std::filesystem::path& path);

/// The key at `path` (empty: the default). Throws std::runtime_error naming the path if there is
/// none, it is no key, or anybody but its owner may read or write it.
SecretKey read_key_file(const std::filesystem::path& path);

}  // namespace roomwise
