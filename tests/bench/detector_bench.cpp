// landmark_svc's detector by image size, and beside it what others pay on the same image.
//
// The same 160 x 120 scene is tiled to every size, so that each pixel has the same share of edges
// and ns_per_pixel shows the growth of cost with pixels alone. JPEG decoding is not included.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "services/landmark_svc/core/landmark_detector.h"
#include "tests/support/synthetic_room.h"

namespace roomwise {
namespace {

using landmark::LandmarkDetector;
using landmark::LandmarkParams;

constexpr int kTileWidth_px = 160;
constexpr int kTileHeight_px = 120;

RgbdFrame render_scene(int width_px, std::uint32_t seed) {
  SyntheticCamera camera;
  camera.width_px = width_px;
  camera.height_px = width_px * 3 / 4;
  return render(furnished_room(), camera, {0.2, -0.2, 0.05}, seed);
}

/// `width_px` x 3/4 of it, tiled with one small view of the furnished room.
RgbdFrame tiled_scene(int width_px) {
  const RgbdFrame tile = render_scene(kTileWidth_px, 0);
  RgbdFrame frame = render_scene(width_px, 0);
  for (int v = 0; v < frame.depth.height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      const auto pixel = static_cast<std::size_t>(v * width_px + u);
      frame.depth.steps[pixel] = tile.depth.at(u % kTileWidth_px, v % kTileHeight_px);
    }
  }
  return frame;
}

/// Processor time of the benchmark's loop, by pixel.
class PixelTimer {
 public:
  void report(benchmark::State& state, const RgbdFrame& frame) const {
    const double loop_ns = 1e9 * static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC;
    state.counters["ns_per_pixel"] = loop_ns / (static_cast<double>(state.iterations()) *
                                                static_cast<double>(frame.depth.size()));
  }

 private:
  std::clock_t start_ = std::clock();
};

void detect_for(benchmark::State& state, const RgbdFrame& frame, const LandmarkParams& params,
                bool whole) {
  LandmarkDetector detector(params);
  if (detector.detect(frame) != landmark::DetectResult::kOk) state.SkipWithError("refused");
  const PixelTimer timer;
  for (auto _ : state) {
    if (whole) {
      benchmark::DoNotOptimize(detector.detect(frame));
    } else {
      detector.find_edges(frame);
      benchmark::DoNotOptimize(detector.edges().data());
    }
  }
  timer.report(state, frame);
  state.counters["edges"] = static_cast<double>(detector.edges().size());
  state.counters["landmarks"] = static_cast<double>(detector.landmarks().size());
}

void edges_tiled(benchmark::State& state) {
  detect_for(state, tiled_scene(static_cast<int>(state.range(0))), {}, false);
}

void whole_tiled(benchmark::State& state) {
  detect_for(state, tiled_scene(static_cast<int>(state.range(0))), {}, true);
}

void edges_room(benchmark::State& state) {
  detect_for(state, render_scene(static_cast<int>(state.range(0)), 0), {}, false);
}

void whole_room(benchmark::State& state) {
  detect_for(state, render_scene(static_cast<int>(state.range(0)), 0), {}, true);
}

void thesis_room(benchmark::State& state) {
  LandmarkParams params;
  params.method = "thesis";
  detect_for(state, render_scene(static_cast<int>(state.range(0)), 0), params, true);
}

/// Depth as Canny takes it: 8 bits, 16 mm a level.
cv::Mat depth_8bit(const RgbdFrame& frame) {
  cv::Mat image(frame.depth.height_px, frame.depth.width_px, CV_8U);
  for (std::size_t i = 0; i < frame.depth.size(); ++i) {
    image.data[i] = static_cast<std::uint8_t>(std::min(frame.depth.steps[i] / 16, 255));
  }
  return image;
}

void canny(benchmark::State& state, const RgbdFrame& frame) {
  cv::setNumThreads(1);
  const cv::Mat image = depth_8bit(frame);
  cv::Mat edges;
  const PixelTimer timer;
  for (auto _ : state) {
    cv::Canny(image, edges, 20.0, 60.0);
    benchmark::DoNotOptimize(edges.data);
  }
  timer.report(state, frame);
}

void canny_tiled(benchmark::State& state) {
  canny(state, tiled_scene(static_cast<int>(state.range(0))));
}

void canny_room(benchmark::State& state) {
  canny(state, render_scene(static_cast<int>(state.range(0)), 0));
}

/// Grey picture with texture: the made room's walls alone would give ORB nothing to do.
cv::Mat textured_grey(const RgbdFrame& frame, std::uint64_t seed) {
  cv::Mat image(frame.depth.height_px, frame.depth.width_px, CV_8U);
  cv::RNG random(seed);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(image, image, {9, 9}, 2.0);
  cv::normalize(image, image, 0, 255, cv::NORM_MINMAX);
  return image;
}

/// What feature SLAM pays for a frame: find, describe and match to the frame before.
void orb_room(benchmark::State& state) {
  cv::setNumThreads(1);
  const RgbdFrame frame = render_scene(static_cast<int>(state.range(0)), 0);
  const cv::Mat image = textured_grey(frame, 1);
  const auto orb = cv::ORB::create(1000);
  const cv::BFMatcher matcher(cv::NORM_HAMMING, true);
  std::vector<cv::KeyPoint> points;
  std::vector<cv::DMatch> matches;
  cv::Mat before;
  cv::Mat now;
  orb->detectAndCompute(textured_grey(frame, 2), cv::noArray(), points, before);
  const PixelTimer timer;
  for (auto _ : state) {
    orb->detectAndCompute(image, cv::noArray(), points, now);
    matcher.match(now, before, matches);
    benchmark::DoNotOptimize(matches.data());
  }
  timer.report(state, frame);
}

#define ROOMWISE_SIZES(name) \
  BENCHMARK(name)->Arg(160)->Arg(320)->Arg(640)->Arg(1280)->Unit(benchmark::kMicrosecond)
ROOMWISE_SIZES(edges_tiled);
ROOMWISE_SIZES(canny_tiled);
ROOMWISE_SIZES(whole_tiled);
ROOMWISE_SIZES(edges_room);
ROOMWISE_SIZES(canny_room);
ROOMWISE_SIZES(whole_room);
ROOMWISE_SIZES(thesis_room);
BENCHMARK(orb_room)->Arg(640)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace roomwise

BENCHMARK_MAIN();
