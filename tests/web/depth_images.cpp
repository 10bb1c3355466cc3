// Writes depth images as PDZ16 and as they are, for decoders in other languages to be held against:
// for each its width, height and size in PDZ16 (uint32), the PDZ16 bytes, then the pixels (uint16),
// all little-endian. usage: depth_images > FILE
#include <bit>
#include <cstdint>
#include <iostream>
#include <span>
#include <vector>

#include "common/image/depth_codec.h"
#include "tests/support/synthetic_room.h"

namespace {

using namespace roomwise;
static_assert(std::endian::native == std::endian::little);

template <class Value>
void put(std::span<const Value> values) {
  std::cout.write(reinterpret_cast<const char*>(values.data()),
                  static_cast<std::streamsize>(values.size_bytes()));
}

void put_image(const std::vector<std::uint16_t>& values, int width_px, int height_px) {
  DepthEncoder encoder;
  std::vector<std::uint8_t> bytes;
  encoder.encode(values, width_px, height_px, bytes);
  const std::uint32_t head[] = {static_cast<std::uint32_t>(width_px),
                                static_cast<std::uint32_t>(height_px),
                                static_cast<std::uint32_t>(bytes.size())};
  put(std::span<const std::uint32_t>(head));
  put(std::span<const std::uint8_t>(bytes));
  put(std::span<const std::uint16_t>(values));
}

/// As a Kinect measures a room: few distinct depths, slopes, holes.
void put_room(int width_px, double noise_quanta, std::uint32_t seed) {
  SyntheticCamera camera;
  camera.width_px = width_px;
  camera.height_px = width_px * 3 / 4;
  camera.noise_quanta = noise_quanta;
  const RgbdFrame frame = render(furnished_room(), camera, {}, seed);
  put_image(frame.depth.steps, camera.width_px, camera.height_px);
}

/// Nothing to predict: kept as it is, or nearly.
void put_noise(int width_px, int height_px, std::uint32_t distinct) {
  std::vector<std::uint16_t> values(static_cast<std::size_t>(width_px * height_px));
  std::uint32_t state = 1;
  for (std::uint16_t& value : values) {
    state = state * 1664525U + 1013904223U;
    value = static_cast<std::uint16_t>((state >> 8U) % distinct * 977U);
  }
  put_image(values, width_px, height_px);
}

}  // namespace

int main() {
  put_image({0}, 1, 1);
  put_image({65535}, 1, 1);
  put_image(std::vector<std::uint16_t>(35, 800), 7, 5);
  for (const std::uint32_t distinct : {1U, 2U, 3U, 60U, 5000U, 65536U}) {
    put_noise(61, 37, distinct);
    put_noise(640, 3, distinct);
    put_noise(1, 200, distinct);
  }
  for (const int width_px : {160, 320, 640}) {
    for (std::uint32_t seed = 1; seed <= 3; ++seed) put_room(width_px, 0.5, seed);
    put_room(width_px, 0.0, 1);
  }
}
