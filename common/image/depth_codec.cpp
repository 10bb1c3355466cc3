#include "common/image/depth_codec.h"

#include <zstd.h>

#include <cstring>
#include <stdexcept>

namespace roomwise {
namespace {

constexpr int kSideMax_px = 4096;
constexpr std::uint8_t kVersion = 0;

struct FreeCompressor {
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
};
struct FreeDecompressor {
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

bool is_side(int px) { return px >= 1 && px <= kSideMax_px; }

}  // namespace

struct DepthEncoder::Memory {
  std::unique_ptr<ZSTD_CCtx, FreeCompressor> zstd{ZSTD_createCCtx()};
};
struct DepthDecoder::Memory {
  std::unique_ptr<ZSTD_DCtx, FreeDecompressor> zstd{ZSTD_createDCtx()};
};

DepthEncoder::DepthEncoder() : memory_(std::make_unique<Memory>()) {}
DepthEncoder::~DepthEncoder() = default;
DepthDecoder::DepthDecoder() : memory_(std::make_unique<Memory>()) {}
DepthDecoder::~DepthDecoder() = default;

void DepthEncoder::encode(std::span<const std::uint16_t> values, int width_px, int height_px,
                          std::vector<std::uint8_t>& out) {
  if (!is_side(width_px) || !is_side(height_px) ||
      values.size() != static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {
    throw std::invalid_argument("depth image: size does not match its values");
  }
  out.resize(1 + ZSTD_compressBound(values.size_bytes()));
  out[0] = kVersion;
  const std::size_t size = ZSTD_compressCCtx(memory_->zstd.get(), out.data() + 1, out.size() - 1,
                                             values.data(), values.size_bytes(), 1);
  if (ZSTD_isError(size)) throw std::logic_error("zstd refused a depth image");
  out.resize(1 + size);
}

bool DepthDecoder::decode(std::span<const std::uint8_t> bytes, int width_px, int height_px,
                          std::span<std::uint16_t> values) {
  if (!is_side(width_px) || !is_side(height_px) || bytes.empty() || bytes[0] != kVersion ||
      values.size() != static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px)) {
    return false;
  }
  return ZSTD_decompressDCtx(memory_->zstd.get(), values.data(), values.size_bytes(),
                             bytes.data() + 1, bytes.size() - 1) == values.size_bytes();
}

}  // namespace roomwise
