#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/image/rgbd_frame.h"

namespace roomwise::segment {

/// The colour that belongs to each pixel of a depth image: a colour image of another size is
/// thinned out or repeated. Cheap to prepare when no size has changed.
class ColorGrid {
 public:
  /// `color` must live as long as it is looked up in, and must not be empty.
  void prepare(const ColorImage& color, int width_px, int height_px) {
    rgb_ = color.rgb.data();
    color_width_ = static_cast<std::size_t>(color.width_px);
    color_height_ = static_cast<std::size_t>(color.height_px);
    height_ = static_cast<std::size_t>(height_px);
    const auto width = static_cast<std::size_t>(width_px);
    if (byte_of_column_.size() == width && columns_of_ == color_width_) return;
    columns_of_ = color_width_;
    byte_of_column_.resize(width);
    for (std::size_t u = 0; u < width; ++u) byte_of_column_[u] = 3 * (u * color_width_ / width);
  }

  /// Start of the colours of a row of the depth image.
  const std::uint8_t* row(std::size_t v) const {
    return rgb_ + 3 * color_width_ * (v * color_height_ / height_);
  }
  /// Whether each pixel of a row has a colour of its own, in order.
  bool is_one_to_one() const { return byte_of_column_.size() == color_width_; }
  /// Red, green and blue of a pixel, from its row's start.
  const std::uint8_t* at(const std::uint8_t* row, std::size_t u) const {
    return row + byte_of_column_[u];
  }

 private:
  const std::uint8_t* rgb_ = nullptr;
  std::size_t color_width_ = 0;
  std::size_t color_height_ = 0;
  std::size_t height_ = 0;
  std::size_t columns_of_ = 0;
  std::vector<std::size_t> byte_of_column_;
};

}  // namespace roomwise::segment
