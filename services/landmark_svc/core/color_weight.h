#pragma once
#include <cstdint>
#include <vector>

#include "common/image/rgbd_frame.h"

namespace roomwise::landmark {

/// How much colour counts beside depth.
struct ColorWeightParams {
  double alpha_max_ratio = 0.3;     ///< weight of colour in full light
  double dark_luma_levels = 20.0;   ///< mean brightness (0-255) at and below which alpha is 0
  double light_luma_levels = 80.0;  ///< and from which it is alpha_max_ratio
  double noise_levels = 4.0;        ///< sigma of one colour channel of one pixel
};

/// Mean brightness of `color` on a coarse grid, (R + 2 G + B) / 4, in [0, 255]; 0 without colour.
double mean_luma_levels(const ColorImage& color);

/// alpha: 0 at dark_luma_levels and below, rising linearly to alpha_max_ratio. beta is 1 - alpha.
/// The depth camera brings its own light, so in the dark depth alone decides.
double color_weight_ratio(const ColorWeightParams& params, double luma_levels);

/// The colour that belongs to depth pixels, for images registered to each other; their sizes may
/// differ. Holds no pixels of its own.
class ColorAtDepth {
 public:
  /// Looks into `frame`, which must outlive the use. Allocates only if the depth image got wider.
  void attach(const RgbdFrame& frame);

  /// False if there is no colour, or it is not registered to depth: then rgb() may not be called.
  bool available() const { return rgb_ != nullptr; }

  /// Red, green, blue of depth pixel (u, v), both inside the depth image.
  const std::uint8_t* rgb(int u_px, int v_px) const {
    return rgb_ + row_offset(v_px) + column_offset_[static_cast<std::size_t>(u_px)];
  }

  /// Euclidean distance of two pixels' colours, [0, 442].
  double distance_levels(int u1_px, int v1_px, int u2_px, int v2_px) const;

 private:
  std::size_t row_offset(int v_px) const {
    return static_cast<std::size_t>(v_px) * static_cast<std::size_t>(color_height_px_) /
           static_cast<std::size_t>(depth_height_px_) * color_row_bytes_;
  }

  const std::uint8_t* rgb_ = nullptr;
  int color_height_px_ = 0;
  int depth_height_px_ = 1;
  std::size_t color_row_bytes_ = 0;
  std::vector<std::size_t> column_offset_;
};

}  // namespace roomwise::landmark
