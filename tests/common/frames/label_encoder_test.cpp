#include "common/frames/label_encoder.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace roomwise {
namespace {

std::vector<std::uint8_t> decoded(const segmentation_t& message) {
  if (message.label_encoding == segmentation_t::ENCODING_RAW8) return message.label_data;
  std::vector<std::uint8_t> labels(
      static_cast<std::size_t>(message.label_width_px * message.label_height_px));
  labels.resize(ZSTD_decompress(labels.data(), labels.size(), message.label_data.data(),
                                message.label_data.size()));
  return labels;
}

RC_GTEST_PROP(LabelEncoder, AnyLabelsComeBackAndNeverGrow, ()) {
  const int width = *rc::gen::inRange(1, 50);
  const int height = *rc::gen::inRange(1, 50);
  const auto levels = *rc::gen::element(1, 3, 256);
  const auto labels = *rc::gen::container<std::vector<std::uint8_t>>(
      static_cast<std::size_t>(width * height),
      rc::gen::map(rc::gen::inRange(0, levels),
                   [](int l) { return static_cast<std::uint8_t>(l); }));
  segmentation_t message{};
  LabelEncoder().encode(labels, width, height, message);
  RC_ASSERT(message.label_size == static_cast<std::int32_t>(message.label_data.size()));
  RC_ASSERT(message.label_data.size() <= labels.size());
  RC_ASSERT(decoded(message) == labels);
}

}  // namespace
}  // namespace roomwise
