#include "common/openni2/openni_images.h"

#include <algorithm>
#include <cstring>

namespace roomwise {
namespace {

struct Rgb {
  std::uint8_t red, green, blue;
};
static_assert(sizeof(Rgb) == 3);

template <class Pixel>
bool sizes_fit(const openni::VideoFrameRef& image) {
  const int width_px = image.getWidth();
  const int height_px = image.getHeight();
  return width_px >= 1 && width_px <= 4096 && height_px >= 1 && height_px <= 4096 &&
         image.getStrideInBytes() >= width_px * static_cast<int>(sizeof(Pixel)) &&
         image.getDataSize() / image.getStrideInBytes() >= height_px;
}

/// Copies rows of `Pixel`, each reversed if `mirrored`, to `out` without gaps.
template <class Pixel>
void copy_rows(const openni::VideoFrameRef& image, bool mirrored, void* out) {
  const auto width_px = static_cast<std::size_t>(image.getWidth());
  const auto* row = static_cast<const std::uint8_t*>(image.getData());
  auto* to = static_cast<std::uint8_t*>(out);
  for (int v = 0; v < image.getHeight(); ++v) {
    std::memcpy(to, row, width_px * sizeof(Pixel));
    if (mirrored) {
      auto* pixels = reinterpret_cast<Pixel*>(to);
      std::reverse(pixels, pixels + width_px);
    }
    row += image.getStrideInBytes();
    to += width_px * sizeof(Pixel);
  }
}

std::size_t pixels_of(const openni::VideoFrameRef& image) {
  return static_cast<std::size_t>(image.getWidth()) * static_cast<std::size_t>(image.getHeight());
}

}  // namespace

bool copy_depth(const openni::VideoFrameRef& image, bool mirrored, DepthImage& depth) {
  const openni::PixelFormat format = image.getVideoMode().getPixelFormat();
  const bool known =
      format == openni::PIXEL_FORMAT_DEPTH_1_MM || format == openni::PIXEL_FORMAT_DEPTH_100_UM;
  if (!known || !sizes_fit<std::uint16_t>(image)) return false;
  depth.width_px = image.getWidth();
  depth.height_px = image.getHeight();
  depth.unit_m = format == openni::PIXEL_FORMAT_DEPTH_1_MM ? 1e-3 : 1e-4;
  depth.steps.resize(pixels_of(image));
  copy_rows<std::uint16_t>(image, mirrored, depth.steps.data());
  return true;
}

bool copy_color(const openni::VideoFrameRef& image, bool mirrored, ColorImage& color) {
  if (image.getVideoMode().getPixelFormat() != openni::PIXEL_FORMAT_RGB888) return false;
  if (!sizes_fit<Rgb>(image)) return false;
  color.width_px = image.getWidth();
  color.height_px = image.getHeight();
  color.rgb.resize(3 * pixels_of(image));
  copy_rows<Rgb>(image, mirrored, color.rgb.data());
  return true;
}

}  // namespace roomwise
