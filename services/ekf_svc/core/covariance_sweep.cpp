#include "services/ekf_svc/core/covariance_sweep.h"

#include <algorithm>

#include "common/multiversion.h"

namespace roomwise::ekf {
namespace {

constexpr std::size_t kRows = 4;  // of a tile; with kTermsAtOnce, all stays in registers
constexpr std::size_t kTermsAtOnce = 4;
constexpr std::size_t kLineSize = 8;  // doubles of a cache line
/// Of a band: its part of a tile, of the next one and of the terms at once stay in the first cache.
constexpr std::size_t kBandColumns = 320;
using Line [[gnu::vector_size(64), gnu::may_alias]] = double;

/// kRows rows from row `i` on, columns [j_begin, j_end).
struct Tile {
  double* rows;
  const double* next_rows;  ///< of the tile that comes next, to be fetched meanwhile
  std::size_t stride;
  std::size_t i;
  std::size_t j_begin;
  std::size_t j_end;
};

/// Count terms, a fixed number so that the coefficients stay in registers.
template <std::size_t Count>
ROOMWISE_IN_EACH_VERSION void add_terms_at_once(const Tile& tile, const SweepTerm* terms) {
  const std::size_t stride = tile.stride;
  double coefficients[Count][kRows];
  const double* right[Count];
  for (std::size_t k = 0; k < Count; ++k) {
    right[k] = terms[k].right;
    for (std::size_t r = 0; r < kRows; ++r) {
      coefficients[k][r] = terms[k].sign * terms[k].left[tile.i + r];
    }
  }
  for (std::size_t j = tile.j_begin; j < tile.j_end; j += kLineSize) {
    Line sum[kRows];
#pragma GCC unroll 4
    for (std::size_t r = 0; r < kRows; ++r) {
      __builtin_prefetch(tile.next_rows + r * stride + j, 1);
      sum[r] = *reinterpret_cast<const Line*>(tile.rows + r * stride + j);
    }
#pragma GCC unroll 4
    for (std::size_t k = 0; k < Count; ++k) {
      const Line factor = *reinterpret_cast<const Line*>(right[k] + j);
#pragma GCC unroll 4
      for (std::size_t r = 0; r < kRows; ++r) sum[r] += coefficients[k][r] * factor;
    }
#pragma GCC unroll 4
    for (std::size_t r = 0; r < kRows; ++r) {
      *reinterpret_cast<Line*>(tile.rows + r * stride + j) = sum[r];
    }
  }
}

ROOMWISE_MULTIVERSION
void add_terms(const Tile& tile, const SweepTerm* terms, std::size_t count) {
  for (; count >= kTermsAtOnce; count -= kTermsAtOnce, terms += kTermsAtOnce) {
    add_terms_at_once<kTermsAtOnce>(tile, terms);
  }
  if (count == 3) add_terms_at_once<3>(tile, terms);
  if (count == 2) add_terms_at_once<2>(tile, terms);
  if (count == 1) add_terms_at_once<1>(tile, terms);
}

}  // namespace

void sweep_upper(double* matrix, std::size_t stride, std::size_t n,
                 std::span<const SweepTerm> terms) {
  for (std::size_t band = 0; band < n; band += kBandColumns) {
    const std::size_t band_end = std::min(n, band + kBandColumns);
    for (std::size_t i = 0; i < band_end; i += kRows) {
      const std::size_t next = i + kRows < band_end ? i + kRows : i;
      const Tile tile{matrix + i * stride,
                      matrix + next * stride,
                      stride,
                      i,
                      std::max(band, i / kLineSize * kLineSize),
                      band_end};
      add_terms(tile, terms.data(), terms.size());
    }
  }
}

}  // namespace roomwise::ekf
