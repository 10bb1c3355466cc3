#include "logs/tools/label_image.h"

#include <zstd.h>

#include <algorithm>

namespace roomwise {
namespace {

constexpr int kLargestSide_px = 4096;

bool side_is_good(int side_px) { return side_px >= 1 && side_px <= kLargestSide_px; }

}  // namespace

std::optional<cv::Mat1b> decode_labels(const segmentation_t& message) {
  const auto& data = message.label_data;
  if (!side_is_good(message.label_width_px) || !side_is_good(message.label_height_px)) {
    return std::nullopt;
  }
  cv::Mat1b labels(message.label_height_px, message.label_width_px);
  if (message.label_encoding == segmentation_t::ENCODING_RAW8) {
    if (data.size() != labels.total()) return std::nullopt;
    std::ranges::copy(data, labels.begin());
    return labels;
  }
  if (message.label_encoding != segmentation_t::ENCODING_ZSTD) return std::nullopt;
  const std::size_t size = ZSTD_decompress(labels.data, labels.total(), data.data(), data.size());
  if (ZSTD_isError(size) != 0 || size != labels.total()) return std::nullopt;
  return labels;
}

}  // namespace roomwise
