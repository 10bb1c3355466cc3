#pragma once
#include <cstddef>
#include <span>

namespace roomwise::ekf {

/// One rank-1 term: sign * left * right^T.
struct SweepTerm {
  const double* left;   ///< at least n rounded up to 8 values, those past n zero
  const double* right;  ///< the same, and on a cache line
  double sign;
};

/// Adds the sum of `terms` to the n x n matrix at `matrix` (row-major, rows on cache lines, room
/// for n rounded up to 8 rows and columns), on and above the diagonal; below it, values of the same
/// tile may change too. The sum must be symmetric. Each cache line of the upper half comes from
/// memory and goes back once: for few terms the sweep runs at the speed of memory. Every element
/// is summed in the order of the terms.
void sweep_upper(double* matrix, std::size_t stride, std::size_t n,
                 std::span<const SweepTerm> terms);

}  // namespace roomwise::ekf
