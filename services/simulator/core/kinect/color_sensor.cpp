#include "services/simulator/core/kinect/color_sensor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/multiversion.h"
#include "services/simulator/core/kinect/pixel_hash.h"

namespace roomwise::simulator {
namespace {

enum Purpose : std::uint32_t { kColorNoise = 16 };
constexpr double kFlickerBars = 1.5;      // over the height of the image
constexpr double kFlickerBarsPerS = 0.7;  // what is left of the difference of 100 and 30 Hz

/// -1 to 1 and back over one unit of `phase`.
double triangle_wave(double phase) {
  const double turn = phase - std::floor(phase);
  return turn < 0.5 ? 4.0 * turn - 1.0 : 3.0 - 4.0 * turn;
}

struct Exposure {
  float gain;
  float shot_variance;  ///< a unit of light after the gain
  float read_variance;
};

/// Nearly Gaussian, unit variance: the sum of three numbers of 7 bits.
constexpr float kBitsSigma = 64.0F;  // sqrt(3 (128^2 - 1) / 12)
inline float noise_of(std::uint32_t bits) {
  const auto sum = static_cast<std::int32_t>((bits & 127) + (bits >> 7 & 127) + (bits >> 14 & 127));
  return (static_cast<float>(sum) - 190.5F) / kBitsSigma;
}

inline float level_of(float light, float noise, const Exposure& exposure) {
  const float bright = light * exposure.gain;
  const float sigma = std::sqrt(bright * exposure.shot_variance + exposure.read_variance);
  const float seen = bright + sigma * noise;
  const float clamped = seen < 0.0F ? 0.0F : seen > 1.0F ? 1.0F : seen;
  return 255.0F * std::sqrt(clamped) + 0.5F;
}

/// Levels of one row, red green blue, 3 x width.
ROOMWISE_MULTIVERSION
void expose_row(const float* red, const float* green, const float* blue, std::uint32_t key,
                const Exposure& exposure, int width, float* levels) {
  for (int u = 0; u < width; ++u) {
    const std::uint32_t bits = hash32(key + static_cast<std::uint32_t>(u));
    const std::uint32_t more = hash32(~bits);
    levels[u] = level_of(red[u], noise_of(bits), exposure);
    levels[width + u] = level_of(green[u], noise_of(more), exposure);
    levels[2 * width + u] = level_of(blue[u], noise_of(bits >> 21 | (more >> 21) << 11), exposure);
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
  return (1.0 + swing) * (1.0 + params.flicker_ratio * bars);
}

ColorSensor::ColorSensor(const ColorSensorParams& params, std::uint32_t seed)
    : params_(params), seed_(seed) {}

double ColorSensor::wanted_gain(const KinectView& view) const {
  constexpr std::size_t kEvery_px =
      7;  // coprime with the usual widths: all columns have their turn
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < view.size(); i += kEvery_px, ++count) {
    // Windows and lamps are white for the gain too, however bright they are.
    sum += std::min(1.0, 0.3 * view.red[i] + 0.6 * view.green[i] + 0.1 * view.blue[i]);
  }
  const double mean = sum / static_cast<double>(std::max<std::size_t>(count, 1));
  return std::clamp(params_.wanted_ratio / std::max(mean, 1e-9), 0.05, params_.gain_max_ratio);
}

void ColorSensor::steer(double wanted_gain) {
  const double step = params_.gain_step_ratio;
  gain_ *= std::clamp(wanted_gain / gain_, 1.0 - step, 1.0 + step);
}

void ColorSensor::expose(const KinectView& view, std::int64_t frame, double t_s, ColorImage& out) {
  const double wanted = wanted_gain(view);
  if (gain_ == 0.0) gain_ = wanted;
  out.width_px = view.width_px;
  out.height_px = view.height_px;
  out.rgb.resize(3 * view.size());
  levels_.resize(3 * static_cast<std::size_t>(view.width_px));
  const std::uint32_t key = stream_key(seed_, frame, kColorNoise);
  for (int v = 0; v < view.height_px; ++v) {
    const double lamps = lamp_factor(params_, t_s, static_cast<double>(v) / view.height_px);
    const Exposure exposure{
        .gain = static_cast<float>(gain_ * lamps),
        .shot_variance = static_cast<float>(params_.shot_noise_ratio * gain_),
        .read_variance = static_cast<float>(std::pow(params_.read_noise_ratio * gain_, 2))};
    const auto begin = static_cast<std::size_t>(v) * static_cast<std::size_t>(view.width_px);
    expose_row(view.red.data() + begin, view.green.data() + begin, view.blue.data() + begin,
               key + static_cast<std::uint32_t>(begin), exposure, view.width_px, levels_.data());
    interleave(levels_.data(), view.width_px, out.rgb.data() + 3 * begin);
  }
  steer(wanted);
}

}  // namespace roomwise::simulator
