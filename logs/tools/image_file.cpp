#include "logs/tools/image_file.h"

#include <fmt/core.h>

#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "common/frames/jpeg.h"
#include "logs/tools/whole_file.h"

namespace roomwise {
namespace {

constexpr int kJpegQuality = 90;

bool is_jpeg(std::span<const std::uint8_t> bytes) {
  return bytes.size() > 2 && bytes[0] == 0xff && bytes[1] == 0xd8;
}

/// Decodes `bytes` or complains about `path`, from which they are.
cv::Mat decoded(const std::filesystem::path& path, const std::vector<std::uint8_t>& bytes,
                int flags) {
  cv::Mat image;
  if (!bytes.empty()) image = cv::imdecode(bytes, flags);
  if (image.empty()) throw std::runtime_error(fmt::format("{}: not an image", path.string()));
  return image;
}

cv::Mat read_png(const std::filesystem::path& path, int type, const char* what) {
  const cv::Mat image = decoded(path, read_whole_file(path), cv::IMREAD_UNCHANGED);
  if (image.type() != type) {
    throw std::runtime_error(fmt::format("{}: must be a {} image", path.string(), what));
  }
  return image;
}

}  // namespace

DepthImage read_depth_png(const std::filesystem::path& path, double unit_m) {
  const cv::Mat1w image = read_png(path, CV_16UC1, "16-bit grey");
  return {.width_px = image.cols,
          .height_px = image.rows,
          .unit_m = unit_m,
          .steps = {image.begin(), image.end()}};
}

cv::Mat1b read_grey_png(const std::filesystem::path& path) {
  return read_png(path, CV_8UC1, "8-bit grey");
}

JpegImage read_color_as_jpeg(const std::filesystem::path& path) {
  std::vector<std::uint8_t> bytes = read_whole_file(path);
  const cv::Mat image = decoded(path, bytes, cv::IMREAD_COLOR);
  const bool reencode = !is_jpeg(bytes);
  if (reencode) cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality});
  return {image.cols, image.rows, std::move(bytes), reencode};
}

JpegImage encode_jpeg(const ColorImage& color) {
  if (color.empty()) return {};
  JpegImage jpeg{
      .width_px = color.width_px, .height_px = color.height_px, .bytes = {}, .reencoded = true};
  JpegEncoder().encode(color.rgb, color.width_px, color.height_px, kJpegQuality, jpeg.bytes);
  return jpeg;
}

void write_png(const std::filesystem::path& path, const cv::Mat3b& image) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".png", image, bytes);
  write_whole_file(path, std::span<const std::uint8_t>(bytes));
}

}  // namespace roomwise
