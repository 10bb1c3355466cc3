#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cstddef>

#include "services/ekf_svc/core/aligned_buffer.h"

namespace roomwise::ekf {

/// A symmetric matrix that grows and shrinks inside memory taken once. Square, row-major; rows
/// start on cache lines; only elements on and above the diagonal are valid, reading below them is
/// translated.
class CovarianceStore {
 public:
  /// Room for `size_max` rows.
  explicit CovarianceStore(std::size_t size_max)
      : stride_(padded(size_max)), values_(padded(size_max) * padded(size_max)) {}

  double at(std::size_t i, std::size_t j) const { return row(std::min(i, j))[std::max(i, j)]; }
  void set(std::size_t i, std::size_t j, double value) {
    row(std::min(i, j))[std::max(i, j)] = value;
  }
  /// The 2 x 2 block whose first element is (i, j), anywhere in the matrix.
  Eigen::Matrix2d block2(std::size_t i, std::size_t j) const {
    return (Eigen::Matrix2d() << at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)).finished();
  }

  double* row(std::size_t i) { return values_.data() + i * stride_; }
  const double* row(std::size_t i) const { return values_.data() + i * stride_; }
  double* data() { return values_.data(); }
  std::size_t stride() const { return stride_; }

  /// Column k of the first n rows, above and below the diagonal, to `column`.
  void copy_column(std::size_t k, std::size_t n, double* column) const;

  /// Whole cache lines a row, and an odd number of them: rows a power of two apart would share
  /// cache sets.
  static constexpr std::size_t padded(std::size_t size) { return ((size + 7) / 8 | 1U) * 8; }

 private:
  std::size_t stride_;
  AlignedBuffer values_;
};

}  // namespace roomwise::ekf
