#pragma once
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/bus/wire_cursor.h"

namespace roomwise {

enum class DecodeResult {
  kOk,
  kTooShort,     ///< no room for a fingerprint
  kForeign,      ///< another type's fingerprint, or another version of this type
  kBadCounts,    ///< a count or string length does not fit the bytes
  kTrailing,     ///< bytes left over after the message
  kUndecodable,  ///< lcm's decoder refused it
};

/// Decodes `bytes` into `message`. Nothing a sender can put on the wire makes this throw, read out
/// of bounds or allocate more than a small multiple of `bytes`: lcm-gen 1.3.1's decoder would
/// (count -1: std::length_error; count 2e9: 8 GB). On failure `message` is unspecified. What
/// `message` held before leaves no trace: by itself that decoder would keep old elements of a list
/// that is empty now.
template <class Message>
[[nodiscard]] DecodeResult decode(std::span<const std::uint8_t> bytes, Message& message) {
  constexpr std::size_t kFingerprintBytes = 8;
  if (bytes.size() < kFingerprintBytes) return DecodeResult::kTooShort;
  std::uint64_t fingerprint = 0;
  for (std::size_t i = 0; i < kFingerprintBytes; ++i) fingerprint = fingerprint << 8U | bytes[i];
  if (fingerprint != static_cast<std::uint64_t>(Message::getHash())) return DecodeResult::kForeign;

  WireCursor cursor(bytes.subspan(kFingerprintBytes));
  if (!WireGuard<Message>::counts_fit(cursor)) return DecodeResult::kBadCounts;
  if (cursor.left() != 0) return DecodeResult::kTrailing;

  const int size = static_cast<int>(bytes.size());
  if (message.decode(bytes.data(), 0, size) != size) return DecodeResult::kUndecodable;
  WireGuard<Message>::fit_lists(message);
  return DecodeResult::kOk;
}

/// Encodes `message` into `bytes`, reusing its memory. Throws std::logic_error if a count member
/// differs from its vector's size: lcm-gen's encoder would read past the vector.
template <class Message>
void encode(const Message& message, std::vector<std::uint8_t>& bytes) {
  if (!WireGuard<Message>::counts_match(message)) {
    throw std::logic_error(std::string("count differs from vector in ") + Message::getTypeName());
  }
  bytes.resize(static_cast<std::size_t>(message.getEncodedSize()));
  const auto size = static_cast<int>(bytes.size());
  if (message.encode(bytes.data(), 0, size) != size) {  // shorter: a NUL inside a string
    throw std::logic_error(std::string("cannot encode ") + Message::getTypeName());
  }
}

}  // namespace roomwise
