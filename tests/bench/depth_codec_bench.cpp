// PDZ16 beside what else could carry a depth image without loss: zstd of the values, and PNG.
#include <benchmark/benchmark.h>
#include <zstd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <string>
#include <vector>

#include "common/image/depth_codec.h"
#include "tests/support/shared_data.h"

namespace roomwise {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Image {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint16_t> steps;
};

/// What a Kinect sees of a wall, a floor and a box before it: 11-bit disparity with noise of half a
/// step, dropouts, and the box's shadow on the left of its edge.
Image simulated_kinect(int width_px, int height_px) {
  std::mt19937 engine(1);
  std::normal_distribution<double> noise(0.0, 0.3);
  Image image{width_px, height_px, {}};
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      const double x = static_cast<double>(u) / width_px;
      const double y = static_cast<double>(v) / height_px;
      const bool box = x > 0.4 && x < 0.6 && y > 0.3 && y < 0.8;
      const bool shadow = x > 0.37 && x <= 0.4 && y > 0.3 && y < 0.8;
      const double wall_m = 3.0 + 0.8 * x;
      const double floor_m = y > 0.55 ? 0.45 / (y - 0.45) : wall_m;
      const double z_m = box ? 1.4 : std::min(wall_m, floor_m);
      const double disparity = std::round((3.3309 - 1.0 / z_m) / 0.0030711 + noise(engine));
      const double back_m = 1.0 / (3.3309 - 0.0030711 * disparity);
      const bool hole = shadow || engine() % 200 == 0;
      image.steps.push_back(hole ? std::uint16_t{0} : static_cast<std::uint16_t>(1000.0 * back_m));
    }
  }
  return image;
}

/// Some of the 16-bit PNG files in a folder of recordings; none if it is not there.
std::vector<Image> recorded(const std::string& folder) {
  std::vector<std::filesystem::path> paths;
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator(shared_data() / folder, missing)) {
    const std::string name = entry.path().filename().string();
    if (name.find("depth") != std::string::npos) paths.push_back(entry.path());
  }
  std::ranges::sort(paths);
  std::vector<Image> images;
  const std::size_t step = std::max<std::size_t>(1, paths.size() / 8);
  for (std::size_t i = 0; i < paths.size(); i += step) {
    const cv::Mat png = cv::imread(paths[i].string(), cv::IMREAD_UNCHANGED);
    if (png.type() != CV_16UC1) continue;
    images.push_back({png.cols, png.rows, {png.begin<std::uint16_t>(), png.end<std::uint16_t>()}});
  }
  return images;
}

class Pdz16 {
 public:
  void encode(const Image& image, Bytes& out) {
    encoder_.encode(image.steps, image.width_px, image.height_px, out);
  }
  bool decode(const Bytes& bytes, Image& image) {
    return decoder_.decode(bytes, image.width_px, image.height_px, image.steps);
  }

 private:
  DepthEncoder encoder_;
  DepthDecoder decoder_;
};

class Zstd {
 public:
  void encode(const Image& image, Bytes& out) {
    out.resize(ZSTD_compressBound(image.steps.size() * 2));
    out.resize(
        ZSTD_compress(out.data(), out.size(), image.steps.data(), image.steps.size() * 2, 1));
  }
  bool decode(const Bytes& bytes, Image& image) {
    const std::size_t size = image.steps.size() * 2;
    return ZSTD_decompress(image.steps.data(), size, bytes.data(), bytes.size()) == size;
  }
};

class Png {
 public:
  void encode(const Image& image, Bytes& out) {
    auto* steps = const_cast<std::uint16_t*>(image.steps.data());
    cv::imencode(".png", cv::Mat(image.height_px, image.width_px, CV_16UC1, steps), out,
                 {cv::IMWRITE_PNG_COMPRESSION, 1});
  }
  bool decode(const Bytes& bytes, Image& image) {
    const cv::Mat png = cv::imdecode(bytes, cv::IMREAD_UNCHANGED);
    if (png.total() != image.steps.size()) return false;
    std::copy_n(png.begin<std::uint16_t>(), image.steps.size(), image.steps.begin());
    return true;
  }
};

template <class Codec>
void encode_and_decode(benchmark::State& state, const std::vector<Image>& images, bool decode) {
  Codec codec;
  std::vector<Bytes> coded(images.size());
  double bytes = 0.0;
  for (std::size_t i = 0; i < images.size(); ++i) {
    codec.encode(images[i], coded[i]);
    bytes += static_cast<double>(coded[i].size()) / static_cast<double>(images.size());
  }
  Image back = images.front();
  Bytes out;
  std::size_t next = 0;
  for (auto _ : state) {
    const std::size_t i = next++ % images.size();
    if (!decode) {
      codec.encode(images[i], out);
    } else if (!codec.decode(coded[i], back)) {
      state.SkipWithError("not decoded");
    }
  }
  state.counters["bytes"] = bytes;
  state.counters["bits_per_px"] = 8.0 * bytes / static_cast<double>(back.steps.size());
}

template <class Codec>
void add(const std::string& codec, const std::string& source, const std::vector<Image>& images) {
  for (const bool decode : {false, true}) {
    const std::string name = source + "/" + codec + (decode ? "/decode" : "/encode");
    benchmark::RegisterBenchmark(name.c_str(), [images, decode](benchmark::State& state) {
      encode_and_decode<Codec>(state, images, decode);
    })->Unit(benchmark::kMillisecond);
  }
}

void add_all(const std::string& source, const std::vector<Image>& images) {
  if (images.empty()) {
    std::fprintf(stderr, "%s: no recording here, skipped\n", source.c_str());
    return;
  }
  add<Pdz16>("pdz16", source, images);
  add<Zstd>("zstd-1", source, images);
  add<Png>("png-1", source, images);
}

}  // namespace
}  // namespace roomwise

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  roomwise::add_all("simulated_640x480", {roomwise::simulated_kinect(640, 480)});
  roomwise::add_all("simulated_320x240", {roomwise::simulated_kinect(320, 240)});
  roomwise::add_all("kinect_v1_640x480", roomwise::recorded("rgbd_7scenes_redkitchen_000_119"));
  roomwise::add_all("primesense_640x480", roomwise::recorded("openni2_frame"));
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
