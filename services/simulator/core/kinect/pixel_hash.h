#pragma once
#include <cstdint>

namespace roomwise::simulator {

/// Scrambles 32 bits: every bit of the input flips each bit of the output in about half of all
/// cases. A bijection (constants: C. Wellons, "Prospecting for hash functions", 2018).
constexpr std::uint32_t hash32(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352dU;
  x ^= x >> 15;
  x *= 0x846ca68bU;
  return x ^ x >> 16;
}

/// Random numbers by place instead of by turn: number i of a stream is hash32(key + i), so that any
/// order of asking gives the same numbers.
constexpr std::uint32_t stream_key(std::uint32_t seed, std::int64_t frame, std::uint32_t purpose) {
  const auto low = static_cast<std::uint32_t>(frame);
  const auto high = static_cast<std::uint32_t>(frame >> 32);
  return hash32(hash32(hash32(hash32(seed + 0x9e3779b9U) ^ low) ^ high) ^ purpose);
}

}  // namespace roomwise::simulator
