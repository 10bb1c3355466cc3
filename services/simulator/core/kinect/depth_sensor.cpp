#include "services/simulator/core/kinect/depth_sensor.h"

#include <algorithm>
#include <cmath>

#include "common/multiversion.h"
#include "services/simulator/core/kinect/pixel_hash.h"

namespace roomwise::simulator {
namespace {

constexpr int kMatchingWidth_px = 640;  // of the grid that disparity is measured on
constexpr int kWindowWidth_px = 9;
constexpr int kWindowHeight_px = 7;
constexpr int kBlindRight_px = 8;    // columns at the right border that a Kinect never measures
constexpr int kDropout_px = 4;       // side of what random dropouts take
constexpr float kEdgeQuanta = 8.0F;  // from here on a difference is an edge to window matching
/// How the light needed differs from place to place, per unit of noise: ragged rims of dark areas.
constexpr float kLightSpread = 0.35F;

enum DepthPurpose : std::uint32_t { kNoise, kPattern, kRagged, kDropout };

struct RowLimits {
  float quanta_least;
  float quanta_most;
  float noise_quanta;
  float light_needed;
};

/// Adds noise to `row` (quanta, 0 is a hole), blanks what cannot be read, and rounds.
ROOMWISE_MULTIVERSION
void measure_row(const float* row, const float* light, const float* noise, const float* pattern,
                 const RowLimits& limits, int width, std::uint16_t* quanta) {
  for (int u = 0; u < width; ++u) {
    const float measured = row[u] + limits.noise_quanta * noise[u] + pattern[u];
    const float spread = kLightSpread * noise[u];
    const float needed = limits.light_needed * (spread > -0.5F ? 1.0F + spread : 0.5F);
    const int is_read =
        static_cast<int>(row[u] > 0.0F) & static_cast<int>(measured >= limits.quanta_least) &
        static_cast<int>(measured <= limits.quanta_most) & static_cast<int>(light[u] >= needed);
    const float whole = measured < 0.0F ? 0.0F : measured > 1e4F ? 1e4F : measured + 0.5F;
    quanta[u] = static_cast<std::uint16_t>(is_read * static_cast<int>(whole));
  }
}

}  // namespace

DepthSensor::DepthSensor(const DepthSensorParams& params, std::uint32_t seed)
    : params_(params), seed_(seed), depth_mm_(kQuantaMax + 1, 0) {
  for (std::size_t i = 1; i < depth_mm_.size(); ++i) {
    const double mm = std::round(1000.0 * params.quanta_m() / static_cast<double>(i));
    depth_mm_[i] = static_cast<std::uint16_t>(mm <= 65535.0 ? mm : 0.0);
  }
}

void DepthSensor::resize(const KinectView& view) {
  if (view.width_px == width_px_ && view.height_px == height_px_) return;
  width_px_ = view.width_px;
  height_px_ = view.height_px;
  const double scale = static_cast<double>(width_px_) / kMatchingWidth_px;
  const auto scaled = [scale](double px) { return static_cast<int>(std::lround(px * scale)); };
  const auto window = [&scaled](int side_px) { return std::clamp(scaled(side_px), 1, 64); };
  shadow_.resize(width_px_);
  ragged_.resize(width_px_, height_px_, std::min(scaled(params_.ragged_px), 4));
  noise_.emplace(width_px_, window(kWindowWidth_px), window(kWindowHeight_px));
  for (auto* image : {&disparity_, &pattern_}) image->assign(view.size(), 0.0F);
  quanta_.assign(view.size(), 0);
  row_.assign(static_cast<std::size_t>(width_px_), 0.0F);
  fill_pattern();
}

void DepthSensor::fill_pattern() {
  const auto sigma = static_cast<float>(params_.depth_pattern_quanta);
  noise_->start(stream_key(seed_, 0, kPattern));
  for (auto out = pattern_.begin(); out != pattern_.end(); out += width_px_) {
    const float* row = noise_->next_row();
    std::transform(row, row + width_px_, out, [sigma](float noise) { return sigma * noise; });
  }
}

void DepthSensor::cast_shadow(const KinectView& view, double projector_px_m) {
  const auto quanta_m = static_cast<float>(params_.quanta_m());
  const double px_per_quantum = projector_px_m / params_.quanta_m();
  const auto width = static_cast<std::size_t>(width_px_);
  for (std::size_t begin = 0; begin < disparity_.size(); begin += width) {
    const auto inverse = std::span(view.inverse_depth_per_m).subspan(begin, width);
    const auto row = std::span(disparity_).subspan(begin, width);
    std::transform(inverse.begin(), inverse.end(), row.begin(),
                   [quanta_m](float inverse_per_m) { return quanta_m * inverse_per_m; });
    shadow_.apply(row, static_cast<float>(px_per_quantum));
  }
}

void DepthSensor::drop_patches(std::uint32_t key, DepthImage& out) {
  const auto limit = static_cast<std::uint32_t>(
      std::min(4294967295.0, params_.depth_dropout_ratio * 4294967296.0));
  for (int v = 0; v < height_px_; v += kDropout_px) {
    for (int u = 0; u < width_px_; u += kDropout_px) {
      if (hash32(key++) >= limit) continue;
      const int columns = std::min(kDropout_px, width_px_ - u);
      for (int row = v; row < std::min(v + kDropout_px, height_px_); ++row) {
        const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(row) * width_px_ + u;
        std::fill_n(quanta_.begin() + begin, columns, std::uint16_t{0});
        std::fill_n(out.steps.begin() + begin, columns, std::uint16_t{0});
      }
    }
  }
}

void DepthSensor::expose_row(const KinectView& view, int v, std::uint32_t key, DepthImage& out) {
  const double quanta_m = params_.quanta_m();
  const RowLimits limits{
      .quanta_least = static_cast<float>(std::max(1.0, quanta_m / params_.depth_far_m)),
      .quanta_most =
          static_cast<float>(std::min(kQuantaMax - 1.0, quanta_m / params_.depth_near_m)),
      .noise_quanta = static_cast<float>(params_.depth_noise_quanta),
      .light_needed = static_cast<float>(params_.light_needed_ratio)};
  const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(v) * width_px_;
  ragged_.copy_row(disparity_, v, kEdgeQuanta, key, row_.data());
  measure_row(row_.data(), view.infrared_ratio.data() + begin, noise_->next_row(),
              pattern_.data() + begin, limits, width_px_, quanta_.data() + begin);
  const int blind_px = kBlindRight_px * width_px_ / kMatchingWidth_px;
  const auto row = quanta_.begin() + begin;
  std::fill_n(row + width_px_ - blind_px, blind_px, std::uint16_t{0});
  std::transform(row, row + width_px_, out.steps.begin() + begin,
                 [this](std::uint16_t quanta) { return depth_mm_[quanta]; });
}

void DepthSensor::expose(const KinectView& view, double projector_px_m, std::int64_t frame,
                         DepthImage& out) {
  resize(view);
  cast_shadow(view, projector_px_m);
  const std::uint32_t ragged_key = stream_key(seed_, frame, kRagged);
  noise_->start(stream_key(seed_, frame, kNoise));
  out.width_px = width_px_;
  out.height_px = height_px_;
  out.unit_m = 0.001;
  out.steps.resize(view.size());
  for (int v = 0; v < height_px_; ++v) expose_row(view, v, ragged_key, out);
  drop_patches(stream_key(seed_, frame, kDropout), out);
}

}  // namespace roomwise::simulator
