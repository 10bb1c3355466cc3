#include "services/simulator/render/kinect_renderer.h"

#include <algorithm>
#include <array>

namespace roomwise::simulator {
namespace {

/// How often a ray may go on: through both faces of two panes, or through one and off a mirror.
constexpr std::size_t kLevels = 4;
constexpr float kMirrorWins = 0.5F;  // from this share on depth is that of the mirror world
/// A ray that goes on starts that much behind the surface, lest it meet it again.
constexpr float kSkip_m = 1e-3F;

Eigen::Isometry3d upright(const Pose2& pose) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(pose.heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T.translation() = Eigen::Vector3d(pose.x_m, pose.y_m, 0.0);
  return T;
}

/// End of the stretch of pixels from `begin` on that show one flat piece, at most `end`.
int run_end(const SurfaceTable& surfaces, const std::uint32_t* triangles, int begin, int end) {
  constexpr int kAtOnce = 8;
  const std::uint32_t first = triangles[begin];
  int u = begin + 1;
  for (; u + kAtOnce <= end; u += kAtOnce) {
    std::uint32_t differs = 0;
    for (int i = 0; i < kAtOnce; ++i) differs |= triangles[u + i] ^ first;
    if (differs != 0) break;
  }
  while (u < end && triangles[u] == first) ++u;
  if (u == end || first == kNoTriangle || triangles[u] == kNoTriangle) return u;
  const bool continues = surfaces.flat_piece(triangles[u]) == surfaces.flat_piece(first);
  return continues ? run_end(surfaces, triangles, u, end) : u;
}

void blend(float* own, const float* seen, float own_share, float seen_share, const Run& run) {
  for (int u = run.begin; u < run.end; ++u) own[u] = own_share * own[u] + seen_share * seen[u];
}

/// What window glass and mirrors make of the depth seen through or in them.
void pass_on_depth(const Material& material, const Run& run, const ViewRow& seen,
                   const ViewRow& own) {
  const float mirror = material.see_through ? 1.0F : material.mirror;
  const bool is_mirror_world = !material.see_through && mirror > kMirrorWins;
  const float kept = (1.0F - mirror) * (1.0F - mirror);  // light goes there and back
  const float passed = is_mirror_world ? mirror * mirror : 0.0F;
  blend(own.infrared_ratio, seen.infrared_ratio, is_mirror_world ? 0.0F : kept, passed, run);
  if (material.see_through || is_mirror_world) {
    blend(own.inverse_depth_per_m, seen.inverse_depth_per_m, 0.0F, is_mirror_world ? 1.0F : 0.0F,
          run);
  }
}

void pass_on_color(const Material& material, const Run& run, const ViewRow& seen,
                   const ViewRow& own) {
  const float mirror = material.see_through ? 1.0F : material.mirror;
  const std::array<float, 3> share =
      material.see_through ? material.color : std::array<float, 3>{mirror, mirror, mirror};
  blend(own.red, seen.red, 1.0F - mirror, share[0], run);
  blend(own.green, seen.green, 1.0F - mirror, share[1], run);
  blend(own.blue, seen.blue, 1.0F - mirror, share[2], run);
}

ViewRow row_of(KinectView& view, int v) {
  const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(v) * view.width_px;
  return {view.inverse_depth_per_m.data() + begin, view.infrared_ratio.data() + begin,
          view.red.data() + begin, view.green.data() + begin, view.blue.data() + begin};
}

}  // namespace

PinholeCamera kinect_camera(double focal_px, int width_px, int height_px) {
  const double f = focal_px * width_px / 640.0;
  return {.fx_px = f, .fy_px = f, .cx_px = 0.5 * width_px, .cy_px = 0.5 * height_px};
}

ViewRow KinectRenderer::Level::row() {
  return {planes[0].data(), planes[1].data(), planes[2].data(), planes[3].data(), planes[4].data()};
}

KinectRenderer::KinectRenderer(const Scene& scene)
    : scene_(scene), surfaces_(scene), caster_(scene, surfaces_), shading_(scene) {}

void KinectRenderer::make_room(int width_px, int height_px, KinectView& out) {
  if (out.width_px != width_px || out.height_px != height_px) out.resize(width_px, height_px);
  triangles_.resize(out.size());
  if (width_px == width_px_) return;
  width_px_ = width_px;
  const auto width = static_cast<std::size_t>(width_px);
  shading_.resize(width_px);
  levels_.resize(kLevels);
  for (Level& level : levels_) {
    level.triangles.resize(width);
    level.from_m.resize(width);
    for (auto& plane : level.planes) plane.resize(width);
  }
}

void KinectRenderer::move_walkers(double t_s) {
  if (scene_.walkers.empty()) return;
  for (std::size_t i = 0; i < scene_.walkers.size(); ++i) {
    const Eigen::Isometry3d T_world_walker = upright(walker_pose(scene_.walkers[i], t_s));
    surfaces_.move(i + 1, T_world_walker);
    caster_.move(i + 1, T_world_walker);
  }
  caster_.commit();
}

void KinectRenderer::render(const Eigen::Isometry3d& T_world_camera, const PinholeCamera& camera,
                            double t_s, int width_px, int height_px, KinectView& out) {
  make_room(width_px, height_px, out);
  move_walkers(t_s);
  cast_and_shade(ray_frame(camera, T_world_camera), Wanted::kBoth, out);
}

void KinectRenderer::render(const Eigen::Isometry3d& T_world_camera, const PinholeCamera& camera,
                            const Eigen::Isometry3d& T_world_color,
                            const PinholeCamera& color_camera, double t_s, int width_px,
                            int height_px, KinectView& out) {
  make_room(width_px, height_px, out);
  move_walkers(t_s);
  cast_and_shade(ray_frame(color_camera, T_world_color), Wanted::kColor, out);
  cast_and_shade(ray_frame(camera, T_world_camera), Wanted::kDepth, out);
}

void KinectRenderer::cast_and_shade(const RayFrame& rays, Wanted wanted, KinectView& out) {
  caster_.cast(rays, out.width_px, out.height_px, triangles_.data());
  for (int v = 0; v < out.height_px; ++v) {
    const std::uint32_t* triangles =
        triangles_.data() + static_cast<std::ptrdiff_t>(v) * out.width_px;
    const ViewRow row = row_of(out, v);
    for (Run run{v, 0, 0}; run.begin < out.width_px; run.begin = run.end) {
      run.end = run_end(surfaces_, triangles, run.begin, out.width_px);
      if (wanted != Wanted::kColor) name_surface(run, triangles[run.begin], out);
      shade_run(rays, run, triangles[run.begin], wanted, 0, row);
    }
  }
}

void KinectRenderer::name_surface(const Run& run, std::uint32_t triangle, KinectView& out) const {
  const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(run.v) * out.width_px + run.begin;
  const bool is_there = triangle != kNoTriangle;
  const auto surface_class =
      is_there ? static_cast<std::uint8_t>(surfaces_[triangle].surface_class) : kNoSurface;
  const std::uint16_t material = is_there ? surfaces_[triangle].material : kNoMaterial;
  std::fill_n(out.surface_class.begin() + begin, run.end - run.begin, surface_class);
  std::fill_n(out.material.begin() + begin, run.end - run.begin, material);
}

void KinectRenderer::shade_run(const RayFrame& rays, const Run& run, std::uint32_t triangle,
                               Wanted wanted, std::size_t level, const ViewRow& row) {
  if (triangle == kNoTriangle) return shading_.nothing(run, row);
  const Surface& surface = surfaces_[triangle];
  if (!shading_.depth(rays, surface, run, row)) return;
  if (wanted != Wanted::kDepth) shading_.color(rays, surface, run, row);
  const Material& material = scene_.materials[surface.material];
  if (!material.see_through && material.mirror <= 0.0F) return;
  if (level < kLevels) look_on(rays, run, surface, wanted, level, row);
}

void KinectRenderer::look_on(const RayFrame& rays, const Run& run, const Surface& surface,
                             Wanted wanted, std::size_t level, const ViewRow& row) {
  const Material& material = scene_.materials[surface.material];
  const RayFrame onward =
      material.see_through ? rays : reflected(rays, surface.normal, surface.offset_m);
  Level& next = levels_[level];
  for (int u = run.begin; u < run.end; ++u) {
    next.from_m[static_cast<std::size_t>(u)] = 1.0F / row.inverse_depth_per_m[u] + kSkip_m;
  }
  caster_.cast_row(onward, run.v, run.begin, run.end, next.from_m.data(), next.triangles.data());
  const ViewRow seen = next.row();
  const std::uint32_t* triangles = next.triangles.data();
  for (Run part{run.v, run.begin, run.begin}; part.begin < run.end; part.begin = part.end) {
    part.end = run_end(surfaces_, triangles, part.begin, run.end);
    shade_run(onward, part, triangles[part.begin], wanted, level + 1, seen);
  }
  pass_on_depth(material, run, seen, row);
  if (wanted != Wanted::kDepth) pass_on_color(material, run, seen, row);
}

}  // namespace roomwise::simulator
