#pragma once
#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <span>
#include <vector>

#include "common/image/rgbd_frame.h"

namespace roomwise {

/// Reads a 16-bit grey PNG as depth in steps of `unit_m`. Throws std::runtime_error naming the file
/// if it is anything else.
DepthImage read_depth_png(const std::filesystem::path& path, double unit_m);

/// An 8-bit grey PNG. Throws std::runtime_error naming the file if it is anything else.
cv::Mat1b read_grey_png(const std::filesystem::path& path);

struct JpegImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> bytes;
  bool reencoded = false;  ///< the file was not a JPEG
};

/// Reads a colour image as JPEG: a JPEG's own bytes, anything else encoded anew at quality 90.
/// Throws std::runtime_error naming the file if it is no image.
JpegImage read_color_as_jpeg(const std::filesystem::path& path);

/// Encodes a colour image at quality 90. Without bytes if the image is empty.
JpegImage encode_jpeg(const ColorImage& color);

/// Writes `image` (8 bit, blue green red) as PNG, whole or not at all. Throws std::runtime_error
/// naming the file.
void write_png(const std::filesystem::path& path, const cv::Mat3b& image);

}  // namespace roomwise
