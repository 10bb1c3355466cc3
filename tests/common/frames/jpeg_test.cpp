#include "common/frames/jpeg.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <stdexcept>
#include <vector>

namespace roomwise {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes stripes(int width_px, int height_px) {
  Bytes rgb;
  for (int i = 0; i < width_px * height_px * 3; ++i) {
    rgb.push_back(static_cast<std::uint8_t>(i / 7 % 256));
  }
  return rgb;
}

Bytes jpeg_of(int width_px, int height_px) {
  Bytes bytes;
  JpegEncoder().encode(stripes(width_px, height_px), width_px, height_px, 85, bytes);
  return bytes;
}

bool decodes(const Bytes& bytes, int width_px, int height_px) {
  Bytes rgb(static_cast<std::size_t>(width_px * height_px * 3));
  return JpegDecoder().decode(bytes, width_px, height_px, rgb);
}

TEST(Jpeg, ConstantColourComesBackWithinThreeLevels) {
  for (const int side_px : {1, 7, 16, 33}) {
    Bytes rgb;
    for (int i = 0; i < side_px * side_px; ++i) rgb.insert(rgb.end(), {200, 30, 90});
    Bytes bytes;
    JpegEncoder().encode(rgb, side_px, side_px, 90, bytes);
    Bytes back(rgb.size());
    ASSERT_TRUE(JpegDecoder().decode(bytes, side_px, side_px, back));
    for (std::size_t i = 0; i < rgb.size(); ++i) EXPECT_NEAR(back[i], rgb[i], 3);
  }
}

TEST(Jpeg, LowerQualityIsSmaller) {
  Bytes coarse;
  Bytes fine;
  JpegEncoder encoder;
  encoder.encode(stripes(64, 64), 64, 64, 30, coarse);
  encoder.encode(stripes(64, 64), 64, 64, 95, fine);
  EXPECT_LT(coarse.size(), fine.size());
}

TEST(Jpeg, AnotherSizeThanItsHeaderSaysIsRefused) {
  const Bytes bytes = jpeg_of(48, 32);
  EXPECT_TRUE(decodes(bytes, 48, 32));
  EXPECT_FALSE(decodes(bytes, 32, 48));
  EXPECT_FALSE(decodes(bytes, 47, 32));
  EXPECT_FALSE(decodes(bytes, 48, 33));
}

TEST(Jpeg, CutAtAnyByteItIsRefused) {
  const Bytes whole = jpeg_of(48, 32);
  for (std::size_t size = 0; size < whole.size() - 2; ++size) {
    ASSERT_FALSE(
        decodes(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)), 48, 32))
        << size << " of " << whole.size();
  }
}

RC_GTEST_PROP(Jpeg, FlippedBytesAreDecodedOrRefused, ()) {
  Bytes bytes = jpeg_of(48, 32);
  const int flips = *rc::gen::inRange(1, 5);
  for (int i = 0; i < flips; ++i) {
    bytes[*rc::gen::inRange<std::size_t>(0, bytes.size())] ^= *rc::gen::nonZero<std::uint8_t>();
  }
  RC_CLASSIFY(!decodes(bytes, 48, 32), "refused");
}

TEST(Jpeg, RefusesBuffersAndQualitiesThatDoNotFit) {
  Bytes bytes = jpeg_of(16, 16);
  Bytes small(16 * 16 * 3 - 1);
  EXPECT_FALSE(JpegDecoder().decode(bytes, 16, 16, small));
  EXPECT_FALSE(JpegDecoder().decode(bytes, -16, -16, small));
  JpegEncoder encoder;
  EXPECT_THROW(encoder.encode(small, 16, 16, 85, bytes), std::invalid_argument);
  EXPECT_THROW(encoder.encode(stripes(16, 16), 16, 16, 0, bytes), std::invalid_argument);
  EXPECT_THROW(encoder.encode(stripes(16, 16), 16, 16, 101, bytes), std::invalid_argument);
  EXPECT_THROW(encoder.encode({}, 0, 0, 85, bytes), std::invalid_argument);
}

}  // namespace
}  // namespace roomwise
