#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace roomwise {

/// Decodes JPEG to red green blue, row by row.
class JpegDecoder {
 public:
  JpegDecoder();
  ~JpegDecoder();
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  /// Decompresses `bytes` into `rgb`, which must hold height x width x 3 bytes. False, with `rgb`
  /// unspecified, if the bytes are not one undamaged JPEG of exactly that size: the size in its
  /// header is compared before anything is decompressed, and any warning of the JPEG library
  /// (a cut or flipped stream) counts as damage.
  [[nodiscard]] bool decode(std::span<const std::uint8_t> bytes, int width_px, int height_px,
                            std::span<std::uint8_t> rgb);

 private:
  struct Library;
  std::unique_ptr<Library> library_;
};

/// Encodes red green blue, row by row, as baseline JPEG with 4:2:0 colour.
class JpegEncoder {
 public:
  JpegEncoder();
  ~JpegEncoder();
  JpegEncoder(const JpegEncoder&) = delete;
  JpegEncoder& operator=(const JpegEncoder&) = delete;

  /// Compresses `rgb` (height x width x 3) into `out`, reusing its memory. quality in [1, 100];
  /// a VGA camera image at 85 takes about 50 KB. Throws std::invalid_argument if rgb.size() is not
  /// width * height * 3, a side is not in [1, 4096] or quality is out of range.
  void encode(std::span<const std::uint8_t> rgb, int width_px, int height_px, int quality,
              std::vector<std::uint8_t>& out);

 private:
  struct Library;
  std::unique_ptr<Library> library_;
};

}  // namespace roomwise
