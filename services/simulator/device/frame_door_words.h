#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace roomwise::simulator::door {

/// Writes `size` bytes (whole 8-byte words) into memory that others may be reading: each word is a
/// releasing store, so that none is seen before what was stored earlier.
inline void store_words(std::uint64_t* shared, const void* bytes, std::size_t size) {
  const auto* from = static_cast<const std::uint8_t*>(bytes);
  for (std::size_t i = 0; i < size / 8; ++i) {
    std::uint64_t word = 0;
    std::memcpy(&word, from + 8 * i, 8);
    std::atomic_ref(shared[i]).store(word, std::memory_order_release);
  }
}

/// The reverse: nothing loaded later is loaded before any of these words.
inline void load_words(std::uint64_t* shared, void* bytes, std::size_t size) {
  auto* to = static_cast<std::uint8_t*>(bytes);
  for (std::size_t i = 0; i < size / 8; ++i) {
    const std::uint64_t word = std::atomic_ref(shared[i]).load(std::memory_order_acquire);
    std::memcpy(to + 8 * i, &word, 8);
  }
}

}  // namespace roomwise::simulator::door
