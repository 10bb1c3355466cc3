#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// What PDZ16's encoder and decoder must agree on to the bit.
///
/// An image is two bands of rows, each coded by a lane of its own so that a processor can work on
/// both at once. A band is coded row by row as if the row above it were all holes. Every pixel
/// is one token under a context made of its neighbours
///
///     ul  u  ur
///      l  x
///
/// and, for a large residual, some raw bits. Pixels are indices into the sorted distinct values.
namespace roomwise::pdz16 {

constexpr std::uint8_t kMagic[3] = {'P', 'Z', 1};  ///< the last is the version
constexpr std::size_t kHeaderBytes = 8;            ///< magic, layout, u16 width, u16 height
constexpr int kSideMax_px = 4096;

enum Layout : std::uint8_t {
  kStored = 0,   ///< values as they are, little-endian
  kValues = 1,   ///< coded; the index is the value itself
  kPalette = 2,  ///< coded; indices into a palette
};

constexpr int kLanes = 2;

/// Rows [first, end) of a lane; empty for the last lanes of an image with few rows.
struct Band {
  int first = 0;
  int end = 0;
};
constexpr Band band(int lane, int height_px) {
  const int rows = (height_px + kLanes - 1) / kLanes;
  return {std::min(lane * rows, height_px), std::min((lane + 1) * rows, height_px)};
}

/// A row of indices with a pixel of margin on both sides. A hole's fill is that of its left
/// neighbour, so that prediction and gradients need not know of holes.
class Row {
 public:
  /// Becomes the row above a band.
  void reset(int width_px) {
    fill_.assign(static_cast<std::size_t>(width_px) + 2, 0);
    hole_.assign(static_cast<std::size_t>(width_px) + 2, 1);
  }
  std::uint16_t* fill() { return fill_.data() + 1; }
  std::uint16_t* hole() { return hole_.data() + 1; }
  const std::uint16_t* fill() const { return fill_.data() + 1; }
  const std::uint16_t* hole() const { return hole_.data() + 1; }

  /// Left margin: continues the row above.
  void open(const Row& above) {
    fill()[-1] = above.fill()[0];
    hole()[-1] = 0;
  }
  /// Right margin: repeats the last pixel.
  void close() {
    fill_.back() = fill_[fill_.size() - 2];
    hole_.back() = hole_[hole_.size() - 2];
  }

 private:
  std::vector<std::uint16_t> fill_;
  std::vector<std::uint16_t> hole_;
};

/// Median edge detector: the median of l, u and l + u - ul (LOCO-I, Weinberger, Seroussi, Sapiro
/// 2000, equation 1). Modulo 2^16, which the three cases never notice.
constexpr std::uint16_t predict(std::uint16_t l, std::uint16_t u, std::uint16_t ul) {
  const int low = std::min(l, u);
  const int high = l + u - low;
  return static_cast<std::uint16_t>(std::max(low, std::min(high, l + u - ul)));
}

/// 0, 1, 2 for a < b, a = b, a > b.
constexpr std::uint16_t order(std::uint16_t a, std::uint16_t b) {
  return static_cast<std::uint16_t>(1 + (a > b) - (a < b));
}

/// Context = above_class + left_class: the signs of the three gradients around the pixel, or which
/// of its neighbours are holes.
constexpr int kContexts = 48;
constexpr std::uint16_t above_class(std::uint16_t ul, std::uint16_t u, std::uint16_t ur,
                                    std::uint16_t hole_u, std::uint16_t hole_ur) {
  const auto holes = static_cast<std::uint16_t>(hole_u + 2 * hole_ur);
  const auto slopes = static_cast<std::uint16_t>(3 * order(ul, u) + order(u, ur));
  return static_cast<std::uint16_t>(4 * (holes != 0 ? 8 + holes : slopes));
}
constexpr std::uint16_t left_class(std::uint16_t l, std::uint16_t ul, std::uint16_t hole_l) {
  return static_cast<std::uint16_t>(order(l, ul) | 3 * hole_l);
}

/// Residuals as 0, -1, 1, -2, 2, ... Modulo 2^16.
constexpr std::uint16_t zigzag(std::uint16_t residual) {
  return static_cast<std::uint16_t>((residual << 1) ^ -(residual >> 15));
}
constexpr std::uint16_t unzigzag(std::uint16_t folded) {
  return static_cast<std::uint16_t>((folded >> 1) ^ -(folded & 1));
}

/// Token 0 is a hole, 1 to 16 a folded residual of 0 to 15, 17 and on one of 5, 6, ... 16 bits,
/// whose bits below the leading one follow as they are.
constexpr std::uint16_t kDirect = 16;
constexpr int kDirectBits = std::bit_width(kDirect);
constexpr int kTokens = 1 + kDirect + 16 - kDirectBits + 1;
constexpr int token_of(std::uint16_t folded) {
  return folded < kDirect ? 1 + folded : 1 + kDirect + std::bit_width(folded) - kDirectBits;
}
constexpr int raw_bits(int token) {
  return token <= kDirect ? 0 : token - kDirect - 2 + kDirectBits;
}

}  // namespace roomwise::pdz16
