// DepthDecoder on bytes nobody encoded, and DepthEncoder's round trip on any image.
#include <algorithm>
#include <span>
#include <vector>

#include "common/image/depth_codec.h"
#include "tests/fuzz/depth_codec_input.h"

namespace {

using Bytes = std::span<const std::uint8_t>;

/// The bytes behind the magic and the size, which are made right so that decoding goes on.
void decode(const DepthCodecInput& input, Bytes bytes) {
  std::vector<std::uint8_t> coded(bytes.begin(), bytes.end());
  if (coded.size() >= 8) {
    coded[0] = 'P';
    coded[1] = 'Z';
    coded[2] = 1;
    coded[4] = static_cast<std::uint8_t>(input.width_px);
    coded[5] = static_cast<std::uint8_t>(input.width_px >> 8);
    coded[6] = static_cast<std::uint8_t>(input.height_px);
    coded[7] = static_cast<std::uint8_t>(input.height_px >> 8);
  }
  std::vector<std::uint16_t> steps(static_cast<std::size_t>(input.width_px * input.height_px));
  static roomwise::DepthDecoder decoder;
  static_cast<void>(decoder.decode(coded, input.width_px, input.height_px, steps));
}

void round_trip(const DepthCodecInput& input, Bytes bytes) {
  const auto width = static_cast<std::size_t>(input.width_px);
  const std::size_t rows = std::min<std::size_t>(bytes.size() / 2 / width, 4096);
  if (rows == 0) return;
  std::vector<std::uint16_t> steps;
  for (std::size_t i = 0; i < rows * width; ++i) {
    const int value = bytes[2 * i] | bytes[2 * i + 1] << 8;
    steps.push_back(static_cast<std::uint16_t>(value & ((1 << input.distinct_bits) - 1)));
  }
  static roomwise::DepthEncoder encoder;
  static roomwise::DepthDecoder decoder;
  std::vector<std::uint8_t> coded;
  const auto height_px = static_cast<int>(rows);
  encoder.encode(steps, input.width_px, height_px, coded);
  std::vector<std::uint16_t> back(steps.size());
  if (!decoder.decode(coded, input.width_px, height_px, back) || back != steps) __builtin_trap();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < DepthCodecInput::kHeaderBytes) return 0;
  const DepthCodecInput input(data);
  const Bytes rest = Bytes(data, size).subspan(DepthCodecInput::kHeaderBytes);
  if (input.mode == DepthCodecInput::kDecode) {
    decode(input, rest);
  } else {
    round_trip(input, rest);
  }
  return 0;
}
