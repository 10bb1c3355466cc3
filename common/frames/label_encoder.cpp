#include "common/frames/label_encoder.h"

#include <new>
#include <stdexcept>

namespace roomwise {
namespace {

constexpr int kLevel = 1;  // labels come in long runs: more effort saves little

}  // namespace

LabelEncoder::LabelEncoder() : context_(ZSTD_createCCtx()) {
  if (!context_) throw std::bad_alloc();
}

void LabelEncoder::encode(const std::vector<std::uint8_t>& labels, int width_px, int height_px,
                          segmentation_t& message) {
  message.label_width_px = width_px;
  message.label_height_px = height_px;
  message.label_encoding = segmentation_t::ENCODING_ZSTD;
  message.label_data.resize(ZSTD_compressBound(labels.size()));
  const std::size_t size =
      ZSTD_compressCCtx(context_.get(), message.label_data.data(), message.label_data.size(),
                        labels.data(), labels.size(), kLevel);
  if (ZSTD_isError(size) != 0U) throw std::logic_error(ZSTD_getErrorName(size));
  message.label_data.resize(size);
  if (size >= labels.size()) {
    message.label_encoding = segmentation_t::ENCODING_RAW8;
    message.label_data = labels;
  }
  message.label_size = static_cast<std::int32_t>(message.label_data.size());
}

}  // namespace roomwise
