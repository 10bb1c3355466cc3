#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace roomwise {

/// PDZ16: lossless compression of 16-bit depth images, made for cameras that measure disparity and
/// so emit only some hundred distinct depths. Values become indices into a palette of the distinct
/// ones; an index is predicted from the pixels to the left and above (median edge detector), and
/// the residual, or that the pixel is a hole, is entropy-coded (rANS) under a context of the slopes
/// and holes around it. depth_model.h has the layout. Any image of 16-bit values comes back
/// exactly, and none grows by more than 8 bytes.
class DepthEncoder {
 public:
  DepthEncoder();
  ~DepthEncoder();
  DepthEncoder(const DepthEncoder&) = delete;
  DepthEncoder& operator=(const DepthEncoder&) = delete;

  /// Compresses `values` (height x width, row by row) into `out`, reusing its memory: nothing is
  /// allocated after the first image of a size.
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
  /// it throw, read or write out of bounds, or allocate more than a few rows and a palette.
  [[nodiscard]] bool decode(std::span<const std::uint8_t> bytes, int width_px, int height_px,
                            std::span<std::uint16_t> values);

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace roomwise
