#include "services/simulator/core/kinect/color_sensor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/multiversion.h"
#include "services/simulator/core/kinect/pixel_hash.h"

namespace roomwise::simulator {
namespace {

constexpr std::uint32_t kColorNoise = 16;  // after the depth sensor's purposes
constexpr double kFlickerBars = 1.5;       // over the height of the image
constexpr double kFlickerBarsPerS = 0.7;   // what is left of the difference of 100 and 30 Hz

/// -1 to 1 and back over one unit of `phase`.
double triangle_wave(double phase) {
  const double turn = phase - std::floor(phase);
  return turn < 0.5 ? 4.0 * turn - 1.0 : 3.0 - 4.0 * turn;
}

/// Nearly Gaussian, unit variance: the sum of three numbers of 7 bits.
inline float noise_of(std::uint32_t bits) {
  constexpr float kMean = 190.5F, kSigma = 64.0F;  // sqrt(3 (128^2 - 1) / 12) = 64.0
  const auto sum = static_cast<std::int32_t>((bits & 127) + (bits >> 7 & 127) + (bits >> 14 & 127));
  return (static_cast<float>(sum) - kMean) / kSigma;
}

struct Exposure {
  float gain;
  float noise_levels;
};

/// 255 (sqrt(x + c) - sqrt(c)) / (sqrt(1 + c) - sqrt(c)), c = kToe: 0 to 255 for light 0 to 1.
constexpr float kToe = 0.01F;
inline float level_of(float light, float noise, const Exposure& exposure) {
  constexpr float kToeRoot = 0.1F;
  constexpr float kScale = 255.0F / (1.00498756F - kToeRoot);  // sqrt(1.01)
  const float level = kScale * (std::sqrt(light * exposure.gain + kToe) - kToeRoot) +
                      exposure.noise_levels * noise + 0.5F;
  return level < 0.0F ? 0.0F : level > 255.0F ? 255.0F : level;
}

/// Three rows of one colour, the middle one being taken; each can be read one pixel to either side.
struct Rows {
  const float* above;
  const float* here;
  const float* below;
};

/// A lens and a mosaic of colour filters never show one pixel alone: a quarter of its light is that
/// of each pair of neighbours.
ROOMWISE_MULTIVERSION
void soften(Rows rows, int width, float* __restrict light) {
  for (int u = 0; u < width; ++u) {
    const float beside = rows.here[u - 1] + rows.here[u + 1] + rows.above[u] + rows.below[u];
    light[u] = 0.5F * rows.here[u] + 0.125F * beside;
  }
}

/// Turns three rows of light, red, green and blue, into levels.
ROOMWISE_MULTIVERSION
void expose_row(std::uint32_t key, Exposure exposure, int width, float* __restrict rows) {
  for (int u = 0; u < width; ++u) {
    const std::uint32_t bits = hash32(key + static_cast<std::uint32_t>(u));
    const std::uint32_t more = hash32(~bits);
    rows[u] = level_of(rows[u], noise_of(bits), exposure);
    rows[width + u] = level_of(rows[width + u], noise_of(more), exposure);
    rows[2 * width + u] =
        level_of(rows[2 * width + u], noise_of(bits >> 21 | (more >> 21) << 11), exposure);
  }
}

/// Planes of levels into pixels of three bytes.
ROOMWISE_MULTIVERSION
void interleave(const float* levels, int width, std::uint8_t* rgb) {
  for (int u = 0; u < width; ++u) {
    rgb[3 * u] = static_cast<std::uint8_t>(static_cast<std::int32_t>(levels[u]));
    rgb[3 * u + 1] = static_cast<std::uint8_t>(static_cast<std::int32_t>(levels[width + u]));
    rgb[3 * u + 2] = static_cast<std::uint8_t>(static_cast<std::int32_t>(levels[2 * width + u]));
  }
}

}  // namespace

double lamp_factor(const ColorSensorParams& params, double t_s, double row_ratio) {
  const double swing = params.lamp_roll_ratio * triangle_wave(t_s / params.lamp_roll_s);
  const double bars = triangle_wave(kFlickerBars * row_ratio + kFlickerBarsPerS * t_s);
  return (1.0 + swing) * (1.0 + params.color_flicker_ratio * bars);
}

ColorSensor::ColorSensor(const ColorSensorParams& params, std::uint32_t seed)
    : params_(params), seed_(seed) {}

double ColorSensor::wanted_gain(const KinectView& view) const {
  constexpr int kEveryRow = 16, kEveryColumn = 4;
  double sum = 0.0;
  std::size_t count = 0;
  for (int v = 0; v < view.height_px; v += kEveryRow) {
    for (int u = 0; u < view.width_px; u += kEveryColumn, ++count) {
      const auto i = static_cast<std::size_t>(v * view.width_px + u);
      // Windows and lamps are white for the gain too, however bright they are.
      sum += std::min(1.0, 0.3 * view.red[i] + 0.6 * view.green[i] + 0.1 * view.blue[i]);
    }
  }
  const double mean = sum / static_cast<double>(std::max<std::size_t>(count, 1));
  return std::clamp(params_.color_wanted_ratio / std::max(mean, 1e-9), 0.05,
                    params_.color_gain_max_ratio);
}

void ColorSensor::steer(double wanted_gain) {
  const double step = params_.color_gain_step_ratio;
  gain_ *= std::clamp(wanted_gain / gain_, 1.0 - step, 1.0 + step);
}

void ColorSensor::gather_light(const KinectView& view, int v) {
  const std::ptrdiff_t width = view.width_px;
  float* out = levels_.data();
  for (const auto* plane : {&view.red, &view.green, &view.blue}) {
    const float* here = plane->data() + v * width;
    const float* above = v > 0 ? here - width : here;
    const float* below = v + 1 < view.height_px ? here + width : here;
    soften({above + 1, here + 1, below + 1}, view.width_px - 2, out + 1);
    out[0] = here[0];
    out[width - 1] = here[width - 1];
    out += width;
  }
}

void ColorSensor::expose(const KinectView& view, std::int64_t frame, double t_s, ColorImage& out) {
  const double wanted = wanted_gain(view);
  if (gain_ == 0.0) gain_ = wanted;
  out.width_px = view.width_px;
  out.height_px = view.height_px;
  out.rgb.resize(3 * view.size());
  levels_.resize(3 * static_cast<std::size_t>(view.width_px));
  const std::uint32_t key = stream_key(seed_, frame, kColorNoise);
  const auto noise_levels = static_cast<float>(params_.color_noise_levels * std::sqrt(gain_));
  for (int v = 0; v < view.height_px; ++v) {
    const double lamps = lamp_factor(params_, t_s, static_cast<double>(v) / view.height_px);
    const Exposure exposure{.gain = static_cast<float>(gain_ * lamps),
                            .noise_levels = noise_levels};
    const auto begin = static_cast<std::size_t>(v) * static_cast<std::size_t>(view.width_px);
    gather_light(view, v);
    expose_row(key + static_cast<std::uint32_t>(begin), exposure, view.width_px, levels_.data());
    interleave(levels_.data(), view.width_px, out.rgb.data() + 3 * begin);
  }
  steer(wanted);
}

}  // namespace roomwise::simulator
