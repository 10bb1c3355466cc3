#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace roomwise {

/// PDZ16: lossless compression of 16-bit depth images, made for cameras that measure disparity and
/// so emit only some hundred distinct depths. Palette of the distinct values, difference of palette
/// index to the pixel on the left, zstd level 1; images with a large palette take differences in
/// byte planes instead. Any image of 16-bit values comes back exactly.
class DepthEncoder {
 public:
  DepthEncoder();
  ~DepthEncoder();
  DepthEncoder(const DepthEncoder&) = delete;
  DepthEncoder& operator=(const DepthEncoder&) = delete;

  /// Compresses `values` (height x width, row by row) into `out`, reusing its memory.
  /// Throws std::invalid_argument if values.size() is not width * height, or a side is not in
  /// [1, 4096].
  void encode(std::span<const std::uint16_t> values, int width_px, int height_px,
              std::vector<std::uint8_t>& out);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

class DepthDecoder {
 public:
  DepthDecoder();
  ~DepthDecoder();
  DepthDecoder(const DepthDecoder&) = delete;
  DepthDecoder& operator=(const DepthDecoder&) = delete;

  /// Decompresses `bytes` into `values`, which must hold width * height elements. False, with
  /// `values` unspecified, if the bytes are not one whole PDZ16 image of that size. No input makes
  /// it throw, read or write out of bounds, or allocate more than a small multiple of the image.
  [[nodiscard]] bool decode(std::span<const std::uint8_t> bytes, int width_px, int height_px,
                            std::span<std::uint16_t> values);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace roomwise
