#pragma once
#include <cstddef>
#include <cstdint>

/// How fuzz_depth_codec reads its input: a header of four bytes, then the rest.
struct DepthCodecInput {
  enum Mode : std::uint8_t { kRoundTrip, kDecode };
  static constexpr std::size_t kHeaderBytes = 4;

  Mode mode = kRoundTrip;
  int width_px = 1;                 ///< 1 to 64
  int height_px = 1;                ///< 1 to 64; of a round trip, as many rows as there are values
  std::uint8_t distinct_bits = 16;  ///< of a round trip: values keep these low bits

  explicit DepthCodecInput(const std::uint8_t* header)
      : mode(header[0] % 2 == 0 ? kRoundTrip : kDecode),
        width_px(header[1] % 64 + 1),
        height_px(header[2] % 64 + 1),
        distinct_bits(static_cast<std::uint8_t>(header[3] % 17)) {}
};
