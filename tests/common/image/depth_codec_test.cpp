#include "common/image/depth_codec.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <numeric>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/shared_data.h"

namespace roomwise {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Steps = std::vector<std::uint16_t>;

struct Image {
  int width_px = 0;
  int height_px = 0;
  Steps steps;
};

Image make_image(int width_px, int height_px, const std::function<int(int, int)>& step_at) {
  Image image{width_px, height_px, {}};
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      image.steps.push_back(static_cast<std::uint16_t>(step_at(u, v)));
    }
  }
  return image;
}

Bytes encoded(const Image& image) {
  Bytes bytes;
  DepthEncoder().encode(image.steps, image.width_px, image.height_px, bytes);
  return bytes;
}

/// The image read back from `bytes`; without steps if the decoder refused them.
Image decoded(const Bytes& bytes, int width_px, int height_px) {
  Image image{width_px, height_px, Steps(static_cast<std::size_t>(width_px * height_px), 0xABCD)};
  if (!DepthDecoder().decode(bytes, width_px, height_px, image.steps)) image.steps.clear();
  return image;
}

bool survives(const Image& image) {
  return decoded(encoded(image), image.width_px, image.height_px).steps == image.steps;
}

/// A surface of `distinct` possible values with steps, noise and holes, as a disparity camera sees.
rc::Gen<Image> surfaces() {
  return rc::gen::map(
      rc::gen::tuple(rc::gen::inRange(1, 70), rc::gen::inRange(1, 50), rc::gen::inRange(1, 6000),
                     rc::gen::inRange(0, 4), rc::gen::arbitrary<std::uint32_t>()),
      [](const std::tuple<int, int, int, int, std::uint32_t>& shape) {
        const auto [width_px, height_px, distinct, noise, seed] = shape;
        std::mt19937 engine(seed);
        const auto below = [&engine](int end) {
          return static_cast<int>(engine() % static_cast<unsigned>(end));
        };
        const int spacing = 65535 / distinct;
        int index = below(distinct);
        int hole_left_px = 0;
        return make_image(width_px, height_px, [&, distinct = distinct, noise = noise](int, int) {
          if (hole_left_px > 0) return hole_left_px--, 0;
          if (below(40) == 0) hole_left_px = below(30);
          if (below(60) == 0) index = below(distinct);
          index = std::clamp(index + below(2 * noise + 1) - noise, 0, distinct - 1);
          return index * spacing;
        });
      });
}

RC_GTEST_PROP(DepthCodec, AnyImageComesBackExactly, ()) {
  const int width_px = *rc::gen::inRange(1, 40);
  const int height_px = *rc::gen::inRange(1, 40);
  const auto count = static_cast<std::size_t>(width_px * height_px);
  const auto steps = *rc::gen::container<Steps>(count, rc::gen::arbitrary<std::uint16_t>());
  RC_ASSERT(survives({width_px, height_px, steps}));
}

RC_GTEST_PROP(DepthCodec, FewValuedImagesComeBackExactly, ()) {
  const auto values = *rc::gen::nonEmpty(rc::gen::arbitrary<Steps>());
  const int width_px = *rc::gen::inRange(1, 64);
  const int height_px = *rc::gen::inRange(1, 64);
  const auto count = static_cast<std::size_t>(width_px * height_px);
  const auto steps = *rc::gen::container<Steps>(count, rc::gen::elementOf(values));
  RC_ASSERT(survives({width_px, height_px, steps}));
}

RC_GTEST_PROP(DepthCodec, SurfacesComeBackExactly, ()) { RC_ASSERT(survives(*surfaces())); }

RC_GTEST_PROP(DepthCodec, OneCoderForManyImagesGivesTheSameBytesAsAFreshOne, ()) {
  DepthEncoder encoder;
  DepthDecoder decoder;
  const auto images = *rc::gen::container<std::vector<Image>>(4, surfaces());
  for (const Image& image : images) {
    Bytes bytes;
    encoder.encode(image.steps, image.width_px, image.height_px, bytes);
    RC_ASSERT(bytes == encoded(image));
    Steps steps(image.steps.size());
    RC_ASSERT(decoder.decode(bytes, image.width_px, image.height_px, steps));
    RC_ASSERT(steps == image.steps);
  }
}

RC_GTEST_PROP(DepthCodec, AnyBytesAreDecodedOrRefused, ()) {
  const auto bytes = *rc::gen::arbitrary<Bytes>();
  Steps steps(64 * 48);
  const bool ok = DepthDecoder().decode(bytes, 64, 48, steps);
  RC_CLASSIFY(ok, "decoded");
}

RC_GTEST_PROP(DepthCodec, DamagedBytesAreDecodedOrRefused, ()) {
  const Image image = *surfaces();
  Bytes bytes = encoded(image);
  const auto flips = *rc::gen::inRange(1, 6);
  for (int i = 0; i < flips; ++i) {
    bytes[*rc::gen::inRange<std::size_t>(0, bytes.size())] ^= *rc::gen::nonZero<std::uint8_t>();
  }
  const Image back = decoded(bytes, image.width_px, image.height_px);
  RC_CLASSIFY(back.steps.empty(), "refused");
}

RC_GTEST_PROP(DepthCodec, ShortenedOrLengthenedBytesAreRefused, ()) {
  const Image image = *surfaces();
  Bytes bytes = encoded(image);
  bytes.resize(
      *rc::gen::distinctFrom(rc::gen::inRange<std::size_t>(0, bytes.size() + 9), bytes.size()));
  RC_ASSERT(decoded(bytes, image.width_px, image.height_px).steps.empty());
}

RC_GTEST_PROP(DepthCodec, AnotherSizeIsRefused, ()) {
  const Image image = *surfaces();
  const int width_px = *rc::gen::inRange(1, 70);
  const int height_px = *rc::gen::inRange(1, 50);
  RC_PRE(width_px != image.width_px || height_px != image.height_px);
  RC_ASSERT(decoded(encoded(image), width_px, height_px).steps.empty());
}

TEST(DepthCodec, HardImagesComeBackExactly) {
  std::mt19937 engine(1);
  const auto noise = [&engine](int, int) { return static_cast<int>(engine() & 0xFFFFU); };
  EXPECT_TRUE(survives(make_image(640, 480, [](int, int) { return 0; }))) << "all invalid";
  EXPECT_TRUE(survives(make_image(640, 480, [](int, int) { return 65535; }))) << "constant";
  EXPECT_TRUE(survives(make_image(256, 256, [](int u, int v) { return 256 * v + u; })))
      << "every value once, in order";
  EXPECT_TRUE(survives(make_image(256, 256, [](int u, int v) {
    return (256 * v + u) * 4051 % 65536;
  }))) << "every value once, shuffled";
  EXPECT_TRUE(survives(make_image(640, 480, noise))) << "noise";
  EXPECT_TRUE(survives(make_image(640, 480, [](int u, int v) { return (u + v) % 2 * 65535; })))
      << "chessboard of extremes";
  EXPECT_TRUE(survives(make_image(640, 480, [](int u, int) { return 3 * u; }))) << "ramp";
  EXPECT_TRUE(survives(make_image(1, 4096, noise))) << "one column";
  EXPECT_TRUE(survives(make_image(4096, 1, noise))) << "one row";
  EXPECT_TRUE(survives(make_image(1, 1, noise))) << "one pixel";
  EXPECT_TRUE(survives(make_image(100, 100, [&engine](int u, int v) {
    return u == 99 && v == 99 ? 65535 : static_cast<int>(engine() % 3);
  }))) << "one outlier at the very end";
}

RC_GTEST_PROP(DepthCodec, NoImageGrowsByMoreThanItsHeader, ()) {
  const auto steps = *rc::gen::nonEmpty(rc::gen::arbitrary<Steps>());
  const Image image{static_cast<int>(steps.size()), 1, steps};
  RC_ASSERT(encoded(image).size() <= 8 + 2 * steps.size());
}

TEST(DepthCodec, EncoderRefusesSizesThatDoNotMatch) {
  DepthEncoder encoder;
  Bytes bytes;
  const Steps steps(12);
  EXPECT_THROW(encoder.encode(steps, 3, 5, bytes), std::invalid_argument);
  EXPECT_THROW(encoder.encode(steps, -3, -4, bytes), std::invalid_argument);
  EXPECT_THROW(encoder.encode({}, 0, 0, bytes), std::invalid_argument);
  EXPECT_THROW(encoder.encode(Steps(4097), 4097, 1, bytes), std::invalid_argument);
}

TEST(DepthCodec, DecoderRefusesSizesThatDoNotMatch) {
  const Bytes bytes = encoded(make_image(4, 3, [](int u, int v) { return u + v; }));
  Steps steps(12);
  DepthDecoder decoder;
  EXPECT_TRUE(decoder.decode(bytes, 4, 3, steps));
  EXPECT_FALSE(decoder.decode(bytes, 4, 3, std::span(steps).first(11)));
  EXPECT_FALSE(decoder.decode(bytes, -4, -3, steps));
  EXPECT_FALSE(decoder.decode(bytes, 0, 0, {}));
  EXPECT_FALSE(decoder.decode({}, 4, 3, steps));
}

/// Kinect v1 11-bit disparity to millimetres (K. Khoshelham's form with S. Burrus's calibration:
/// z = 1 / (3.33 - 0.00307 d) metres).
int millimetres(int disparity) {
  if (disparity >= 1047) return 0;
  const double z_m = 1.0 / (3.3309495161 - 0.0030711016 * disparity);
  return static_cast<int>(1000.0 * z_m + 0.5);
}

Image image_of_png(const std::filesystem::path& path) {
  const cv::Mat png = cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  Image image{png.cols, png.rows, {}};
  if (png.type() == CV_16UC1)
    image.steps.assign(png.begin<std::uint16_t>(), png.end<std::uint16_t>());
  return image;
}

Image image_of_kinect_dump(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(file)), {});
  const std::size_t first = bytes.size() - 2 * 640 * 480;  // after the PGM header, little-endian
  return make_image(640, 480, [&](int u, int v) {
    const std::size_t at = first + 2 * static_cast<std::size_t>(640 * v + u);
    return millimetres(static_cast<std::uint8_t>(bytes[at]) |
                       static_cast<std::uint8_t>(bytes[at + 1]) << 8);
  });
}

std::vector<Image> images_in(const std::filesystem::path& folder) {
  std::vector<Image> images;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".pgm")) images.push_back(image_of_kinect_dump(entry.path()));
    if (name.find("depth") != std::string::npos) images.push_back(image_of_png(entry.path()));
  }
  return images;
}

class RecordedDepth : public testing::TestWithParam<const char*> {};

TEST_P(RecordedDepth, ComesBackExactlyInAtMost70Kilobytes) {
  ROOMWISE_NEED_DATA(GetParam());
  const std::vector<Image> images = images_in(shared_data() / GetParam());
  ASSERT_FALSE(images.empty());
  for (const Image& image : images) {
    const Bytes bytes = encoded(image);
    ASSERT_EQ(decoded(bytes, image.width_px, image.height_px).steps, image.steps);
    EXPECT_LE(bytes.size(), 70'000U);
  }
}

INSTANTIATE_TEST_SUITE_P(DepthCodec, RecordedDepth,
                         testing::Values("fakenect_dump", "openni2_frame",
                                         "rgbd_7scenes_redkitchen_000_119"));

}  // namespace
}  // namespace roomwise
