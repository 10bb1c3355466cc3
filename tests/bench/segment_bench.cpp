// segment_svc's parts beside OpenCV's own mixture of Gaussians, on the same samples and pixels.
#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>
#include <opencv2/ml.hpp>
#include <vector>

#include "services/segment_svc/core/color/color_table.h"
#include "services/segment_svc/core/color/mixture.h"
#include "services/segment_svc/core/segmenter.h"
#include "tests/support/synthetic_room.h"

namespace {

using roomwise::segment::ColorFeature;

constexpr int kParts = 3;
constexpr int kSamples = 4000;

const roomwise::RgbdFrame& frame() {
  static const roomwise::RgbdFrame frame =
      roomwise::render(roomwise::furnished_room(), {.height_m = 0.4, .pitch_rad = 0.1}, {}, 1);
  return frame;
}

/// Three clouds of colour with other spreads along each axis; sums of draws, the same everywhere.
std::vector<ColorFeature> samples() {
  cv::RNG random(7);
  std::vector<ColorFeature> samples;
  for (int i = 0; i < kSamples; ++i) {
    const int cloud = i % kParts;
    samples.push_back({0.4 * cloud + 0.05 * random.gaussian(1.0),
                       -0.3 * cloud + (0.03 + 0.04 * cloud) * random.gaussian(1.0),
                       4.0 + 0.3 * cloud + 0.15 * random.gaussian(1.0)});
  }
  return samples;
}

cv::Mat1d as_rows(const std::vector<ColorFeature>& features) {
  cv::Mat1d rows(static_cast<int>(features.size()), 3);
  for (int i = 0; i < rows.rows; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      rows(i, axis) = features[static_cast<std::size_t>(i)][axis];
    }
  }
  return rows;
}

cv::Ptr<cv::ml::EM> opencv_mixture(const cv::Mat1d& rows) {
  cv::theRNG().state = 1;
  const auto mixture = cv::ml::EM::create();
  mixture->setClustersNumber(kParts);
  mixture->setCovarianceMatrixType(cv::ml::EM::COV_MAT_GENERIC);
  mixture->trainEM(rows);
  return mixture;
}

void our_training(benchmark::State& state) {
  const auto training = samples();
  double log_likelihood = 0.0;
  for (auto _ : state) {
    const auto mixture = roomwise::segment::fit_mixture(training, kParts);
    log_likelihood = roomwise::segment::mean_log_likelihood(*mixture, training);
  }
  state.counters["mean_log_likelihood"] = log_likelihood;
}
BENCHMARK(our_training)->Name("mixture/roomwise/train")->Unit(benchmark::kMillisecond);

void opencv_training(benchmark::State& state) {
  const cv::Mat1d rows = as_rows(samples());
  double log_likelihood = 0.0;
  for (auto _ : state) {
    const auto mixture = opencv_mixture(rows);
    log_likelihood = 0.0;
    for (int i = 0; i < rows.rows; ++i) {
      log_likelihood += mixture->predict2(rows.row(i), cv::noArray())[0] / rows.rows;
    }
  }
  state.counters["mean_log_likelihood"] = log_likelihood;
}
BENCHMARK(opencv_training)->Name("mixture/opencv/train")->Unit(benchmark::kMillisecond);

void our_classification(benchmark::State& state) {
  const auto mixture = *roomwise::segment::fit_mixture(samples(), kParts);
  const roomwise::segment::ColorTable table({mixture, mixture, mixture});
  std::vector<std::uint8_t> labels(frame().depth.size());
  for (auto _ : state) {
    const std::uint8_t* rgb = frame().color.rgb.data();
    for (std::uint8_t& label : labels) {
      label = table.classify(rgb);
      rgb += 3;
    }
    benchmark::DoNotOptimize(labels.data());
  }
}
BENCHMARK(our_classification)->Name("classes/roomwise/vga")->Unit(benchmark::kMillisecond);

/// Three classes, as ours; features are made beforehand, which is not counted.
void opencv_classification(benchmark::State& state) {
  const auto mixture = opencv_mixture(as_rows(samples()));
  std::vector<ColorFeature> features;
  const auto& rgb = frame().color.rgb;
  for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
    features.push_back(roomwise::segment::color_feature(rgb[i], rgb[i + 1], rgb[i + 2]));
  }
  const cv::Mat1d rows = as_rows(features);
  double sum = 0.0;
  for (auto _ : state) {
    for (int k = 0; k < 3; ++k) {
      for (int i = 0; i < rows.rows; ++i) sum += mixture->predict2(rows.row(i), cv::noArray())[0];
    }
  }
  benchmark::DoNotOptimize(sum);
}
BENCHMARK(opencv_classification)->Name("classes/opencv/vga")->Unit(benchmark::kMillisecond);

void whole_frame(benchmark::State& state, const char* model) {
  roomwise::segment::SegmentParams params;
  params.model = model;
  roomwise::segment::Segmenter segmenter(params);
  roomwise::segment::Segmentation result;
  for (auto _ : state) {
    segmenter.segment(frame(), result);
    benchmark::DoNotOptimize(result.labels.data());
  }
}
BENCHMARK_CAPTURE(whole_frame, geometry, "geometry")
    ->Name("frame/geometry/vga")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(whole_frame, fused, "fused")
    ->Name("frame/fused/vga")
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
