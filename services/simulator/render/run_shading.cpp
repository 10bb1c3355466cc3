#include "services/simulator/render/run_shading.h"

#include <algorithm>
#include <cmath>

#include "common/multiversion.h"
#include "services/simulator/render/pattern.h"

namespace roomwise::simulator {
namespace {

constexpr float kInverseDepthLeast_per_m = 1e-3F;
constexpr double kPlaneThroughEye_m = 1e-9;
constexpr std::array<float, 3> kSky{0.55F, 0.7F, 0.9F};

/// a + b x + c x^2, x counting pixels from the run's first.
struct Line {
  float a, b;
  float operator()(float x) const { return a + b * x; }
};
struct Parabola {
  float a, b, c;
  float operator()(float x) const { return a + x * (b + c * x); }
};

Line line(double a, double b) { return {static_cast<float>(a), static_cast<float>(b)}; }

Parabola squared_length(const Eigen::Vector3d& first, const Eigen::Vector3d& step) {
  return {static_cast<float>(first.squaredNorm()), static_cast<float>(2.0 * first.dot(step)),
          static_cast<float>(step.squaredNorm())};
}

struct DepthRun {
  Line inverse_depth;
  Parabola direction_squared;
  float light;  ///< reflectance times the eye's distance from the plane, m
  int count;
};

ROOMWISE_MULTIVERSION
void fill_depth(DepthRun run, float* inverse_depth, float* infrared, float* depth_m) {
  for (int i = 0; i < run.count; ++i) {
    const auto x = static_cast<float>(i);
    const float on_plane = run.inverse_depth(x);
    const float inverse = on_plane > kInverseDepthLeast_per_m ? on_plane : kInverseDepthLeast_per_m;
    const float squared = run.direction_squared(x);
    // cos / range^2, with cos = distance / range and range = depth |direction|.
    infrared[i] = run.light * inverse * inverse * inverse / (squared * std::sqrt(squared));
    inverse_depth[i] = inverse;
    depth_m[i] = 1.0F / inverse;
  }
}

/// One texture coordinate over a run: value = at_eye + depth * slope(x).
struct TextureRun {
  float at_eye;
  Line slope;
  float slope_per_u, slope_per_v;
  float inverse_per_u, inverse_per_v;  ///< of inverse depth, 1/m a pixel
  int count;
};

ROOMWISE_MULTIVERSION
void fill_texture(TextureRun run, const float* depth_m, float* value, float* width) {
  for (int i = 0; i < run.count; ++i) {
    const float depth = depth_m[i];
    const float beyond_eye = depth * run.slope(static_cast<float>(i));
    // d(depth * slope): depth changes by -depth^2 d(inverse).
    const float per_u = depth * (run.slope_per_u - beyond_eye * run.inverse_per_u);
    const float per_v = depth * (run.slope_per_v - beyond_eye * run.inverse_per_v);
    value[i] = run.at_eye + beyond_eye;
    width[i] = std::abs(per_u) + std::abs(per_v);
  }
}

/// A lamp over a plane: squared distance to it = eye_squared - 2 depth along(x) + depth^2 |d|^2.
struct LampRun {
  float height_m;  ///< over the plane, on the eye's side
  float eye_squared;
  Line along;
  Parabola direction_squared;
  std::array<float, 3> power;
  int count;
};

/// Light of the lamp at column x of the run, where it is `depth` away from the eye.
inline float light_at(const LampRun& run, float x, float depth) {
  const float raw =
      run.eye_squared + depth * (depth * run.direction_squared(x) - 2.0F * run.along(x));
  const float squared = raw > 1e-4F ? raw : 1e-4F;
  return run.height_m / (std::sqrt(squared) * (1.0F + squared));
}

/// The first lamp, and the light that comes from everywhere.
ROOMWISE_MULTIVERSION
void first_lamp(LampRun run, float ambient, const float* depth_m, float* red, float* green,
                float* blue) {
  for (int i = 0; i < run.count; ++i) {
    const float light = light_at(run, static_cast<float>(i), depth_m[i]);
    red[i] = ambient + run.power[0] * light;
    green[i] = ambient + run.power[1] * light;
    blue[i] = ambient + run.power[2] * light;
  }
}

ROOMWISE_MULTIVERSION
void add_lamp(LampRun run, const float* depth_m, float* red, float* green, float* blue) {
  for (int i = 0; i < run.count; ++i) {
    const float light = light_at(run, static_cast<float>(i), depth_m[i]);
    red[i] += run.power[0] * light;
    green[i] += run.power[1] * light;
    blue[i] += run.power[2] * light;
  }
}

/// Turns light that falls on a surface of one colour into light that comes from it.
ROOMWISE_MULTIVERSION
void reflect_plain(const Material& material, int count, float* red, float* green, float* blue) {
  const auto [r, g, b] = material.color;
  for (int i = 0; i < count; ++i) {
    red[i] *= r;
    green[i] *= g;
    blue[i] *= b;
  }
}

/// Turns light that falls on a surface of two colours into light that comes from it.
ROOMWISE_MULTIVERSION
void reflect(const float* mix, const Material& material, int count, float* red, float* green,
             float* blue) {
  const auto [r, g, b] = material.color;
  const auto [r2, g2, b2] = material.second_color;
  const float dr = r2 - r, dg = g2 - g, db = b2 - b;
  for (int i = 0; i < count; ++i) {
    red[i] *= r + mix[i] * dr;
    green[i] *= g + mix[i] * dg;
    blue[i] *= b + mix[i] * db;
  }
}

/// Signed distance of the eye from the plane, along the surface's normal.
double eye_height(const RayFrame& rays, const Surface& surface) {
  return surface.normal.dot(rays.origin_m) - surface.offset_m;
}

}  // namespace

RunShading::RunShading(const Scene& scene) : scene_(scene) {}

void RunShading::resize(int width_px) {
  for (auto* row : {&depth_m_, &s_, &t_, &s_width_, &t_width_, &mix_})
    row->resize(static_cast<std::size_t>(width_px));
}

bool RunShading::depth(const RayFrame& rays, const Surface& surface, const Run& run,
                       const ViewRow& row) {
  const double height_m = eye_height(rays, surface);
  if (std::abs(height_m) < kPlaneThroughEye_m) {
    nothing(run, row);
    return false;
  }
  const Eigen::Vector3d first = rays.direction(run.begin, run.v);
  const DepthRun plane{.inverse_depth = line(-surface.normal.dot(first) / height_m,
                                             -surface.normal.dot(rays.step_u) / height_m),
                       .direction_squared = squared_length(first, rays.step_u),
                       .light = static_cast<float>(std::abs(height_m)) *
                                scene_.materials[surface.material].infrared_reflectance,
                       .count = run.end - run.begin};
  fill_depth(plane, row.inverse_depth_per_m + run.begin, row.infrared_ratio + run.begin,
             depth_m_.data());
  return true;
}

void RunShading::find_places(const RayFrame& rays, const Surface& surface, const Run& run) {
  const double height_m = eye_height(rays, surface);
  const double per_size = 1.0 / std::max(1e-3F, scene_.materials[surface.material].pattern_size_m);
  const Eigen::Vector3d first = rays.direction(run.begin, run.v);
  const auto fill = [&](const Eigen::Vector3d& gradient, double at_origin_m, float* value,
                        float* width) {
    const Eigen::Vector3d per_m = per_size * gradient;
    const auto along = [&](const Eigen::Vector3d& way) {
      return static_cast<float>(per_m.dot(way));
    };
    const auto inverse_per = [&](const Eigen::Vector3d& step) {
      return static_cast<float>(-surface.normal.dot(step) / height_m);
    };
    const TextureRun texture{
        .at_eye = static_cast<float>(per_size * at_origin_m + per_m.dot(rays.origin_m)),
        .slope = {along(first), along(rays.step_u)},
        .slope_per_u = along(rays.step_u),
        .slope_per_v = along(rays.step_v),
        .inverse_per_u = inverse_per(rays.step_u),
        .inverse_per_v = inverse_per(rays.step_v),
        .count = run.end - run.begin};
    fill_texture(texture, depth_m_.data(), value, width);
  };
  fill(surface.s_gradient, surface.s_at_origin_m, s_.data(), s_width_.data());
  fill(surface.t_gradient, surface.t_at_origin_m, t_.data(), t_width_.data());
}

void RunShading::light(const RayFrame& rays, const Surface& surface, const Run& run,
                       const ViewRow& row) const {
  const auto ambient = static_cast<float>(scene_.ambient * scene_.lamp_level);
  float* const red = row.red + run.begin;
  float* const green = row.green + run.begin;
  float* const blue = row.blue + run.begin;
  bool is_lit = false;
  const double side = eye_height(rays, surface) < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d first = rays.direction(run.begin, run.v);
  const auto level = static_cast<float>(scene_.lamp_level);
  for (const Lamp& lamp : scene_.lamps) {
    const Eigen::Vector3d lamp_m = lamp.position_m.cast<double>();
    const double height_m = side * (surface.normal.dot(lamp_m) - surface.offset_m);
    if (height_m <= 0.0) continue;
    const Eigen::Vector3d from_eye_m = lamp_m - rays.origin_m;
    const LampRun over{
        .height_m = static_cast<float>(height_m),
        .eye_squared = static_cast<float>(from_eye_m.squaredNorm()),
        .along = line(from_eye_m.dot(first), from_eye_m.dot(rays.step_u)),
        .direction_squared = squared_length(first, rays.step_u),
        .power = {level * lamp.power[0], level * lamp.power[1], level * lamp.power[2]},
        .count = run.end - run.begin};
    if (is_lit) {
      add_lamp(over, depth_m_.data(), red, green, blue);
    } else {
      first_lamp(over, ambient, depth_m_.data(), red, green, blue);
    }
    is_lit = true;
  }
  if (is_lit) return;
  for (float* color : {red, green, blue}) std::fill_n(color, run.end - run.begin, ambient);
}

void RunShading::color(const RayFrame& rays, const Surface& surface, const Run& run,
                       const ViewRow& row) {
  const Material& material = scene_.materials[surface.material];
  const int count = run.end - run.begin;
  float* const red = row.red + run.begin;
  float* const green = row.green + run.begin;
  float* const blue = row.blue + run.begin;
  light(rays, surface, run, row);
  if (material.pattern == Pattern::kPlain) {
    return reflect_plain(material, count, red, green, blue);
  }
  find_places(rays, surface, run);
  pattern_mix(material.pattern, {s_.data(), t_.data(), s_width_.data(), t_width_.data()}, count,
              mix_.data());
  reflect(mix_.data(), material, count, red, green, blue);
}

void RunShading::nothing(const Run& run, const ViewRow& row) const {
  const auto fill = [&run](float* plane, float value) {
    std::fill(plane + run.begin, plane + run.end, value);
  };
  fill(row.inverse_depth_per_m, 0.0F);
  fill(row.infrared_ratio, 0.0F);
  const auto level = static_cast<float>(scene_.lamp_level);
  fill(row.red, level * kSky[0]);
  fill(row.green, level * kSky[1]);
  fill(row.blue, level * kSky[2]);
}

}  // namespace roomwise::simulator
