#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

/// Range asymmetric numeral systems (J. Duda, "Asymmetric numeral systems", 2013, section 3): an
/// entropy coder that spends log2(kTotal / frequency) bits on a symbol. The encoder works from the
/// last symbol to the first, the decoder from the first to the last.
namespace roomwise::rans {

constexpr int kTotalBits = 10;
constexpr std::uint32_t kTotal = 1U << kTotalBits;  ///< what the frequencies of a table add up to

/// States between symbols lie in [kStateMin, 2^31); words of 16 bits move in and out below.
constexpr std::uint32_t kStateMin = 1U << 15;
constexpr int kStateBits = 31;

/// One symbol of a table as the encoder needs it. The quotient state / frequency is taken as
/// state * reciprocal >> kQuotientShift: exact, because state * frequency < 2^kQuotientShift.
struct EncoderSymbol {
  std::uint64_t reciprocal = 0;
  std::uint32_t state_end = 0;   ///< states from here on would leave the range
  std::uint16_t start = 0;       ///< sum of the frequencies of the symbols before it
  std::uint16_t complement = 0;  ///< kTotal - frequency
};
constexpr int kQuotientShift = kStateBits + kTotalBits;

constexpr EncoderSymbol encoder_symbol(std::uint32_t frequency, std::uint32_t start) {
  if (frequency == 0) return {};
  return {((1ULL << kQuotientShift) + frequency - 1) / frequency,
          frequency << (kStateBits - kTotalBits), static_cast<std::uint16_t>(start),
          static_cast<std::uint16_t>(kTotal - frequency)};
}

/// Writes words downwards from the end of its memory, which must reach.
class Encoder {
 public:
  Encoder() = default;
  explicit Encoder(std::uint16_t* end) : next_(end), end_(end) {}

  void put(const EncoderSymbol& symbol) {
    make_room(symbol.state_end);
    const auto quotient = static_cast<std::uint32_t>(state_ * symbol.reciprocal >> kQuotientShift);
    state_ += symbol.start + quotient * symbol.complement;  // quotient * kTotal + remainder + start
  }
  void put_raw(std::uint32_t value, int bits) {
    make_room(1U << (kStateBits - bits));
    state_ = state_ << bits | value;
  }
  /// Writes the state; what the decoder reads first.
  void finish() {
    *--next_ = static_cast<std::uint16_t>(state_);
    *--next_ = static_cast<std::uint16_t>(state_ >> 16);
  }
  std::span<const std::uint16_t> words() const { return {next_, end_}; }

 private:
  void make_room(std::uint32_t limit) {
    if (state_ < limit) return;
    *--next_ = static_cast<std::uint16_t>(state_);
    state_ >>= 16;
  }

  std::uint32_t state_ = kStateMin;
  std::uint16_t* next_ = nullptr;
  std::uint16_t* end_ = nullptr;
};

/// Reads the little-endian words of an Encoder. Bytes that no encoder wrote give arbitrary symbols
/// and raw bits, but nothing is read beyond the end.
class Decoder {
 public:
  Decoder() = default;
  explicit Decoder(std::span<const std::uint8_t> bytes)
      : next_(bytes.data()), end_(bytes.data() + (bytes.size() & ~std::size_t{1})) {
    const std::uint32_t high = word();
    state_ = (high << 16 | word()) & ((1U << kStateBits) - 1);
  }

  /// Where in [0, kTotal) the next symbol's place is; then take() that symbol.
  std::uint32_t place() const { return state_ & (kTotal - 1); }
  void take(std::uint32_t frequency, std::uint32_t start) {
    state_ = frequency * (state_ >> kTotalBits) + place() - start;
    refill();
  }
  std::uint32_t take_raw(int bits) {
    const std::uint32_t value = state_ & ((1U << bits) - 1);
    state_ >>= bits;
    refill();
    return value;
  }
  /// Whether everything was read and the encoder's first state is reached.
  bool at_end() const { return next_ == end_ && state_ == kStateMin && !overrun_; }

 private:
  void refill() {
    if (state_ < kStateMin) state_ = state_ << 16 | word();
  }
  std::uint32_t word() {
    if (next_ == end_) {
      overrun_ = true;
      return 0;
    }
    const auto value = static_cast<std::uint32_t>(next_[0] | next_[1] << 8);
    next_ += 2;
    return value;
  }

  std::uint32_t state_ = 0;
  const std::uint8_t* next_ = nullptr;
  const std::uint8_t* end_ = nullptr;
  bool overrun_ = false;
};

/// Scales counts to frequencies that add up to kTotal and are positive where the count is.
/// All zero if all counts are. There must be fewer counts than kTotal.
inline void normalise(std::span<const std::uint32_t> counts, std::span<std::uint16_t> frequencies) {
  std::uint64_t sum = 0;
  for (const std::uint32_t count : counts) sum += count;
  if (sum == 0) {
    for (auto& frequency : frequencies) frequency = 0;
    return;
  }
  // Rounded down to leave room for the rare ones; what is over goes to the most frequent.
  std::size_t largest = 0;
  std::int32_t left = kTotal;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto scaled = static_cast<std::uint16_t>(counts[i] * std::uint64_t{kTotal} / sum);
    frequencies[i] = counts[i] != 0 && scaled == 0 ? 1 : scaled;
    left -= frequencies[i];
    if (frequencies[i] > frequencies[largest]) largest = i;
  }
  frequencies[largest] = static_cast<std::uint16_t>(frequencies[largest] + left);
}

}  // namespace roomwise::rans
