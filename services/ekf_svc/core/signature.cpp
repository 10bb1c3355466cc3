#include "services/ekf_svc/core/signature.h"

#include <algorithm>
#include <cmath>

namespace roomwise::ekf {
namespace {

constexpr double kVarianceMax_log2 = 1.0;   // beyond it a colour says nothing
constexpr double kVarianceMin_log2 = 1e-4;  // light changes more than this
constexpr double kLogMax = 20.0;

bool is_usable(const Signature& s) {
  return std::abs(s.red_log) < kLogMax && std::abs(s.blue_log) < kLogMax && s.variance_log2 > 0.0 &&
         s.variance_log2 < kVarianceMax_log2;
}

}  // namespace

SignatureDistance distance(const Signature& a, const Signature& b) {
  if (!is_usable(a) || !is_usable(b)) return {};
  const double red = a.red_log - b.red_log;
  const double blue = a.blue_log - b.blue_log;
  const double variance = std::max(a.variance_log2 + b.variance_log2, kVarianceMin_log2);
  return {(red * red + blue * blue) / variance, 2};
}

Signature cleaned(const Signature& signature) {
  return is_usable(signature) ? signature : Signature{};
}

Signature fused(const Signature& a, const Signature& b) {
  if (!is_usable(b)) return a;
  if (!is_usable(a)) return b;
  const double weight_a = 1.0 / std::max(a.variance_log2, kVarianceMin_log2);
  const double weight_b = 1.0 / std::max(b.variance_log2, kVarianceMin_log2);
  const double sum = weight_a + weight_b;
  return {(weight_a * a.red_log + weight_b * b.red_log) / sum,
          (weight_a * a.blue_log + weight_b * b.blue_log) / sum,
          std::max(1.0 / sum, kVarianceMin_log2)};
}

}  // namespace roomwise::ekf
