#pragma once
#include <cstdint>
#include <vector>

/// Overwrites the first eight bytes with the fingerprint of `Message`, so that a decoder reads on.
template <class Message>
void set_fingerprint(std::vector<std::uint8_t>& bytes) {
  auto fingerprint = static_cast<std::uint64_t>(Message::getHash());
  for (std::size_t i = 8; i-- > 0; fingerprint >>= 8) {
    if (i < bytes.size()) bytes[i] = static_cast<std::uint8_t>(fingerprint);
  }
}
