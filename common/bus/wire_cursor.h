#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace roomwise {

/// Steps over the bytes of an encoded LCM message without making anything of them, so that counts
/// can be checked against the bytes left before a decoder believes them. Every step returns false
/// when the bytes do not reach. LCM's wire format is big-endian.
class WireCursor {
 public:
  explicit WireCursor(std::span<const std::uint8_t> bytes) : left_(bytes) {}

  /// Bytes not stepped over yet.
  std::size_t left() const { return left_.size(); }

  /// Steps over an array of elements of `size` bytes with these dimensions; none: one element.
  template <class... Dimensions>
  bool skip_elements(std::size_t size, Dimensions... dimensions) {
    std::uint64_t total = size;
    const bool in_bounds = (scale(total, static_cast<std::int64_t>(dimensions)) && ...);
    return in_bounds && skip(total);
  }

  /// Reads the integer of `size` bytes that says how long an array is. A count is never negative
  /// and never fits an int32_t's overflow (lcm-gen computes lengths in int).
  bool read_count(std::size_t size, std::int64_t& count) {
    if (left_.size() < size) return false;
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value = value << 8U | left_[i];
    const std::uint64_t largest =
        size == 8 ? std::numeric_limits<std::int64_t>::max() : (1ULL << (8 * size - 1)) - 1;
    if (value > largest || value > left_.size()) return false;
    count = static_cast<std::int64_t>(value);
    return skip(size);
  }

  /// A string: int32 length with its terminating NUL, then the bytes. No NUL before the last:
  /// lcm-gen would encode the string only up to there, shorter than it says it will.
  bool skip_string() {
    std::int64_t length = 0;
    if (!read_count(4, length) || length < 1) return false;
    const auto size = static_cast<std::size_t>(length);
    if (size > left_.size()) return false;
    const auto text = left_.first(size);
    return std::find(text.begin(), text.end(), 0) == text.end() - 1 && skip(size);
  }

 private:
  bool scale(std::uint64_t& total, std::int64_t dimension) const {
    if (dimension < 0) return false;
    total *= static_cast<std::uint64_t>(dimension);
    return total <= left_.size();
  }
  bool skip(std::uint64_t bytes) {
    if (bytes > left_.size()) return false;
    left_ = left_.subspan(static_cast<std::size_t>(bytes));
    return true;
  }

  std::span<const std::uint8_t> left_;
};

/// Made for every message by lcmtypes/generate:
///   static bool counts_fit(WireCursor&)       the counts on the wire fit the bytes that follow
///   static bool counts_match(const Message&)  count members equal the sizes of their vectors
///   static void fit_lists(Message&)           gives vectors the sizes their count members say
template <class Message>
struct WireGuard;

/// Whether a count member says what its vector holds.
constexpr bool count_is(std::int64_t count, std::size_t size) {
  return count >= 0 && static_cast<std::uint64_t>(count) == size;
}

}  // namespace roomwise
