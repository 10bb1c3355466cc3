#pragma once
#include <cstdint>
#include <vector>

namespace roomwise::simulator {

/// Gaussian noise of unit variance whose pixels are alike over a window, row after row: the mean of
/// white noise over a window. Autocorrelation at a shift of (i, j) pixels is
/// (1 - |i| / width) (1 - |j| / height). Made for a sensor that matches windows of that size.
class CorrelatedNoise {
 public:
  /// Throws std::invalid_argument unless the window's sides are in [1, 64] and width_px >= 1.
  CorrelatedNoise(int width_px, int window_width_px, int window_height_px);

  /// Starts an image. The same key gives the same image.
  void start(std::uint32_t key);

  /// The next row; valid until the following call. Shape: width_px.
  const float* next_row();

 private:
  void add_row();

  int width_px_ = 0;
  int window_width_px_ = 0;
  int window_height_px_ = 0;
  int padded_px_ = 0;  ///< of a white row, which reaches beyond the image
  float scale_ = 0.0F;
  std::uint32_t key_ = 0;
  std::uint32_t rows_made_ = 0;
  std::vector<std::int16_t> white_;       ///< as many white rows as the window is high, a ring
  std::vector<std::int32_t> column_sum_;  ///< over them
  std::vector<float> row_;
};

}  // namespace roomwise::simulator
