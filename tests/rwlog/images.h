#pragma once
#include <filesystem>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace roomwise {

inline constexpr int kMadeWidth_px = 320;
inline constexpr int kMadeHeight_px = 240;

/// A depth image full of different values, with 0 and 65535 in two corners.
inline cv::Mat1w made_depth() {
  cv::Mat1w depth(kMadeHeight_px, kMadeWidth_px);
  for (int i = 0; i < static_cast<int>(depth.total()); ++i) {
    depth(i / kMadeWidth_px, i % kMadeWidth_px) = static_cast<std::uint16_t>(1000 + i % 5003);
  }
  depth(0, 0) = 0;
  depth(kMadeHeight_px - 1, kMadeWidth_px - 1) = 65535;
  return depth;
}

inline cv::Mat3b made_color() {
  cv::Mat3b color(kMadeHeight_px, kMadeWidth_px);
  for (int i = 0; i < static_cast<int>(color.total()); ++i) {
    const auto grey = static_cast<std::uint8_t>(i % 251);
    color(i / kMadeWidth_px, i % kMadeWidth_px) = {grey, 90, 200};
  }
  return color;
}

inline void write_image(const std::filesystem::path& path, const cv::Mat& image) {
  std::filesystem::create_directories(path.parent_path());
  cv::imwrite(path.string(), image);
}

}  // namespace roomwise
