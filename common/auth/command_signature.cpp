#include "common/auth/command_signature.h"

#include <sodium.h>

#include <bit>
#include <cstddef>
#include <vector>

namespace roomwise {
namespace {

static_assert(sizeof(SecretKey) == crypto_auth_KEYBYTES);

/// The bytes that are signed: what they are for, then each field in eight bytes, low byte first.
class SignedBytes {
 public:
  explicit SignedBytes(const velocity_command_t& command) {
    for (const char letter : {'V', 'E', 'L', '_', 'C', 'M', 'D', '1'}) {
      bytes_[size_++] = static_cast<std::uint8_t>(letter);
    }
    add(static_cast<std::uint64_t>(command.utime));
    add(std::bit_cast<std::uint64_t>(command.allowed_speed_mps));
    add(std::bit_cast<std::uint64_t>(command.allowed_turn_rate_radps));
    add(static_cast<std::uint64_t>(command.reason));
    add(static_cast<std::uint64_t>(command.expiry_utime));
    add(static_cast<std::uint64_t>(command.session));
    add(static_cast<std::uint64_t>(command.sequence));
  }
  const std::uint8_t* data() const { return bytes_.data(); }
  std::size_t size() const { return size_; }

 private:
  void add(std::uint64_t value) {
    for (unsigned shift = 0; shift < 64; shift += 8) {
      bytes_[size_++] = static_cast<std::uint8_t>(value >> shift);
    }
  }
  std::array<std::uint8_t, 64> bytes_{};
  std::size_t size_ = 0;
};

}  // namespace

void sign(const SecretKey& key, velocity_command_t& command) {
  const SignedBytes bytes(command);
  command.signature.resize(crypto_auth_BYTES);
  command.signature_size = crypto_auth_BYTES;
  crypto_auth(command.signature.data(), bytes.data(), bytes.size(), key.data());
}

Signature check_signature(const SecretKey& key, const velocity_command_t& command) {
  // Decoding an empty array leaves what the message held before: its size alone counts.
  if (command.signature_size == 0) return Signature::kMissing;
  if (command.signature_size != crypto_auth_BYTES ||
      command.signature.size() != crypto_auth_BYTES) {
    return Signature::kForged;
  }
  const SignedBytes bytes(command);
  const int differs =
      crypto_auth_verify(command.signature.data(), bytes.data(), bytes.size(), key.data());
  return differs == 0 ? Signature::kGenuine : Signature::kForged;
}

}  // namespace roomwise
