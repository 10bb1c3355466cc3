#include "services/simulator/core/kinect/correlated_noise.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/multiversion.h"
#include "services/simulator/core/kinect/pixel_hash.h"

namespace roomwise::simulator {
namespace {

constexpr int kWhiteBits = 12;  // 64 x 64 of them fit 32 bits, and 16 of a column 16

/// Replaces a row of the ring by new white noise and keeps the sums over the ring's columns.
ROOMWISE_MULTIVERSION
void replace_row(std::uint32_t key, int count, std::int16_t* row, std::int32_t* column_sum) {
  for (int i = 0; i < count; ++i) {
    const std::uint32_t bits = hash32(key + static_cast<std::uint32_t>(i));
    const auto white = static_cast<std::int16_t>(
        static_cast<std::int32_t>(bits >> (32 - kWhiteBits)) - (1 << (kWhiteBits - 1)));
    column_sum[i] += white - row[i];
    row[i] = white;
  }
}

ROOMWISE_MULTIVERSION
void sum_across(const std::int32_t* column_sum, int window, int count, float mean, float scale,
                float* row) {
  for (int u = 0; u < count; ++u) row[u] = 0.0F;
  for (int k = 0; k < window; ++k) {
    for (int u = 0; u < count; ++u) row[u] += static_cast<float>(column_sum[u + k]);
  }
  for (int u = 0; u < count; ++u) row[u] = (row[u] - mean) * scale;
}

}  // namespace

CorrelatedNoise::CorrelatedNoise(int width_px, int window_width_px, int window_height_px)
    : width_px_(width_px),
      window_width_px_(window_width_px),
      window_height_px_(window_height_px),
      padded_px_(width_px + window_width_px - 1) {
  const auto is_side = [](int side_px) { return side_px >= 1 && side_px <= 64; };
  if (width_px < 1 || !is_side(window_width_px) || !is_side(window_height_px)) {
    throw std::invalid_argument("correlated noise: width or window out of range");
  }
  const double white_sigma = std::sqrt(std::ldexp(1.0, 2 * kWhiteBits) / 12.0);
  scale_ = static_cast<float>(1.0 / (white_sigma * std::sqrt(window_width_px * window_height_px)));
  const auto padded = static_cast<std::size_t>(padded_px_);
  white_.resize(padded * static_cast<std::size_t>(window_height_px));
  column_sum_.resize(padded);
  row_.resize(static_cast<std::size_t>(width_px));
}

void CorrelatedNoise::start(std::uint32_t key) {
  key_ = key;
  rows_made_ = 0;
  std::fill(white_.begin(), white_.end(), std::int16_t{0});
  std::fill(column_sum_.begin(), column_sum_.end(), 0);
  for (int i = 1; i < window_height_px_; ++i) add_row();
}

void CorrelatedNoise::add_row() {
  const auto padded = static_cast<std::size_t>(padded_px_);
  const std::size_t place = rows_made_ % static_cast<std::uint32_t>(window_height_px_);
  const std::uint32_t row_key = key_ + rows_made_ * static_cast<std::uint32_t>(padded_px_);
  replace_row(row_key, padded_px_, white_.data() + place * padded, column_sum_.data());
  ++rows_made_;
}

const float* CorrelatedNoise::next_row() {
  add_row();
  // White values are whole numbers from -2^11 to 2^11 - 1: their mean is -1/2.
  const auto mean = -0.5F * static_cast<float>(window_width_px_ * window_height_px_);
  sum_across(column_sum_.data(), window_width_px_, width_px_, mean, scale_, row_.data());
  return row_.data();
}

}  // namespace roomwise::simulator
