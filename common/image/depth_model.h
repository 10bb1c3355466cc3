#pragma once
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "common/image/rgbd_frame.h"

/// What PDZ16's encoder and decoder must agree on to the bit.
///
/// Bytes: magic and version, layout, u16 width, u16 height (little-endian throughout); then,
/// stored: the values. Coded: with a palette its size and the steps between its values, ascending
/// from 0; for each of kContexts contexts the number of frequencies, and the frequencies of its
/// tokens 0, 1, ... out of rans::kTotal; the lanes' sizes in words of 16 bits (all these as
/// varints, seven bits a byte, the lowest first); the lanes' words.
///
/// An image is four bands of rows, each coded by a lane of its own so that a processor can work on
/// several at once. A band is coded row by row as if the row above it were all holes. Every pixel
/// is one token under a context made of its neighbours
///
///     ul  u  ur
///      l  x
///
/// and, for a large residual, some raw bits. Pixels are indices into the sorted distinct values, or
/// the values themselves; 0 is a hole either way. For prediction and gradients a hole stands for
/// its left neighbour, the pixel left of a row for the row's upper left one, and the pixel right of
/// a row for the row's last.
namespace roomwise::pdz16 {

constexpr std::uint8_t kMagic[3] = {'P', 'Z', 1};  ///< the last is the version
constexpr std::size_t kHeaderBytes = 8;

enum Layout : std::uint8_t { kStored = 0, kValues = 1, kPalette = 2 };

constexpr std::size_t kLanes = 4;

/// Rows of a lane, from the top of the image down; the first lanes may have one more than the last.
constexpr int band_rows(std::size_t lane, int height_px) {
  constexpr int kCount = static_cast<int>(kLanes);
  return height_px / kCount + (static_cast<int>(lane) < height_px % kCount ? 1 : 0);
}

/// Median edge detector: the median of l, u and l + u - ul (LOCO-I: Weinberger, Seroussi, Sapiro
/// 2000, equation 1).
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
constexpr std::size_t kContexts = 48;
constexpr std::uint16_t above_class(std::uint16_t ul, std::uint16_t u, std::uint16_t ur,
                                    bool hole_u, bool hole_ur) {
  const int holes = hole_u + 2 * hole_ur;
  const int slopes = 3 * order(ul, u) + order(u, ur);
  return static_cast<std::uint16_t>(4 * (holes != 0 ? 8 + holes : slopes));
}
constexpr std::uint16_t kLeftHole = 3;
/// `hole_class` is kLeftHole if l is a hole, else 0.
constexpr std::uint16_t left_class(std::uint16_t l, std::uint16_t ul, std::uint16_t hole_class) {
  return static_cast<std::uint16_t>(order(l, ul) | hole_class);
}

/// Residuals 0, -1, 1, -2, 2, ... as 0, 1, 2, 3, 4, ... Modulo 2^16.
constexpr std::uint16_t fold(std::uint16_t residual) {
  return static_cast<std::uint16_t>((residual << 1) ^ -(residual >> 15));
}
constexpr std::uint16_t unfold(std::uint16_t folded) {
  return static_cast<std::uint16_t>((folded >> 1) ^ -(folded & 1));
}

/// Token 0 is a hole, 1 to 16 a folded residual of 0 to 15, 17 and on one of 5, 6, ... 16 bits,
/// whose bits below the leading one follow as they are.
constexpr std::uint16_t kDirect = 16;
constexpr int kDirectBits = std::bit_width(kDirect);
constexpr std::size_t kTokens = 1 + kDirect + 16 - kDirectBits + 1;
constexpr int token_of(std::uint16_t folded) {
  return folded < kDirect ? 1 + folded : 1 + kDirect + std::bit_width(folded) - kDirectBits;
}
constexpr int raw_bits(int token) {
  return token <= kDirect ? 0 : token - kDirect - 2 + kDirectBits;
}

}  // namespace roomwise::pdz16
