#include "services/ekf_svc/core/covariance_sweep.h"

#include <stdexcept>

#include "common/multiversion.h"

namespace roomwise::ekf {
namespace {

constexpr std::size_t kRows = 4;     // of a tile; its coefficients and sums stay in registers
constexpr std::size_t kColumns = 8;  // one cache line
using Line [[gnu::vector_size(64), gnu::may_alias]] = double;

struct Coefficients {
  double of[kSweepTermsMax][kRows];
};

void load_coefficients(std::span<const SweepTerm> terms, std::size_t i0, Coefficients& c) {
  for (std::size_t k = 0; k < terms.size(); ++k) {
    for (std::size_t r = 0; r < kRows; ++r) c.of[k][r] = terms[k].sign * terms[k].left[i0 + r];
  }
}

ROOMWISE_MULTIVERSION
void sweep_rows(double* rows, std::size_t stride, std::size_t j_begin, std::size_t j_end,
                const SweepTerm* terms, std::size_t term_count, const Coefficients& c) {
  for (std::size_t j = j_begin; j < j_end; j += kColumns) {
    Line* p0 = reinterpret_cast<Line*>(rows + j);
    Line* p1 = reinterpret_cast<Line*>(rows + stride + j);
    Line* p2 = reinterpret_cast<Line*>(rows + 2 * stride + j);
    Line* p3 = reinterpret_cast<Line*>(rows + 3 * stride + j);
    Line sum0 = *p0, sum1 = *p1, sum2 = *p2, sum3 = *p3;
    for (std::size_t k = 0; k < term_count; ++k) {
      const Line right = *reinterpret_cast<const Line*>(terms[k].right + j);
      sum0 += c.of[k][0] * right;
      sum1 += c.of[k][1] * right;
      sum2 += c.of[k][2] * right;
      sum3 += c.of[k][3] * right;
    }
    *p0 = sum0, *p1 = sum1, *p2 = sum2, *p3 = sum3;
  }
}

}  // namespace

void sweep_upper(double* matrix, std::size_t stride, std::size_t n,
                 std::span<const SweepTerm> terms) {
  if (terms.size() > kSweepTermsMax) throw std::logic_error("covariance sweep: too many terms");
  Coefficients coefficients;
  for (std::size_t i = 0; i < n; i += kRows) {
    load_coefficients(terms, i, coefficients);
    sweep_rows(matrix + i * stride, stride, i / kColumns * kColumns, n, terms.data(), terms.size(),
               coefficients);
  }
}

}  // namespace roomwise::ekf
