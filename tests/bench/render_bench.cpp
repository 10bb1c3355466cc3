// The simulated Kinect, one core: what a frame costs, and beside it the same rays through nothing
// but Embree, which is the limit. rays_per_s counts one ray a pixel.
#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

#include <cstdint>
#include <limits>

#include "services/simulator/render/simulated_kinect.h"
#include "services/simulator/scenario/scenario.h"
#include "tests/support/build_paths.h"

namespace roomwise::simulator {
namespace {

constexpr int kWidth_px = 640;
constexpr int kHeight_px = 480;
constexpr int kLanes = 16;
constexpr int kTile_px = 4;

const Scene& living_room() {
  static const Scenario scenario =
      load_scenario(source_folder().string() + "/services/simulator/scenarios/living_room.toml");
  return scenario.scene;
}

/// The camera turns a little with every frame, so that no two are alike.
Eigen::Isometry3d pose(std::int64_t frame) {
  const Scene& scene = living_room();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translation() << scene.start.x_m, scene.start.y_m, 0.0;
  T.linear() = Eigen::AngleAxisd(0.02 * static_cast<double>(frame % 100), Eigen::Vector3d::UnitZ())
                   .toRotationMatrix();
  return T * T_robot_camera(scene.camera);
}

void count_rays(benchmark::State& state) {
  state.counters["rays_per_s"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * kWidth_px * kHeight_px,
                         benchmark::Counter::kIsRate);
}

/// The triangles of a scene in an Embree scene of its own, and one packet that is sent through it.
class BareEmbree {
 public:
  explicit BareEmbree(const Scene& scene)
      : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    for (const Mesh& mesh : scene.meshes) add(mesh);
    rtcCommitScene(scene_);
  }
  BareEmbree(const BareEmbree&) = delete;
  BareEmbree& operator=(const BareEmbree&) = delete;
  ~BareEmbree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }

  /// Sends one ray a pixel; returns how many met something.
  int cast(const RayFrame& rays) {
    int hits = 0;
    for (int v = 0; v < kHeight_px; v += kTile_px) {
      for (int u = 0; u < kWidth_px; u += kTile_px) hits += cast_tile(rays, u, v);
    }
    return hits;
  }

 private:
  void add(const Mesh& mesh) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* corner = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               mesh.corners_m.size()));
    for (const auto& p_m : mesh.corners_m) corner = std::copy_n(p_m.data(), 3, corner);
    auto* index = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), mesh.triangles.size()));
    for (const auto& triangle : mesh.triangles) index = std::copy_n(triangle.data(), 3, index);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
  }

  int cast_tile(const RayFrame& rays, int u, int v) {
    const Eigen::Vector3f origin = rays.origin_m.cast<float>();
    const Eigen::Vector3f first = rays.direction(u, v).cast<float>();
    const Eigen::Vector3f du = rays.step_u.cast<float>(), dv = rays.step_v.cast<float>();
    for (int i = 0; i < kLanes; ++i) {
      const auto column = static_cast<float>(i % kTile_px), row = static_cast<float>(i / kTile_px);
      packet_.ray.org_x[i] = origin.x();
      packet_.ray.org_y[i] = origin.y();
      packet_.ray.org_z[i] = origin.z();
      packet_.ray.dir_x[i] = first.x() + column * du.x() + row * dv.x();
      packet_.ray.dir_y[i] = first.y() + column * du.y() + row * dv.y();
      packet_.ray.dir_z[i] = first.z() + column * du.z() + row * dv.z();
      packet_.ray.tnear[i] = 0.0F;
      packet_.ray.tfar[i] = std::numeric_limits<float>::infinity();
      packet_.ray.mask[i] = ~0U;
      packet_.ray.flags[i] = 0;
      packet_.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    alignas(64) static constexpr int kAll[kLanes] = {-1, -1, -1, -1, -1, -1, -1, -1,
                                                     -1, -1, -1, -1, -1, -1, -1, -1};
    rtcIntersect16(kAll, scene_, &context, &packet_);
    return packet_.hit.geomID[0] != RTC_INVALID_GEOMETRY_ID;
  }

  RTCDevice device_;
  RTCScene scene_;
  RTCRayHit16 packet_{};
};

void bare_embree(benchmark::State& state) {
  BareEmbree embree(living_room());
  const PinholeCamera camera = kinect_camera(525.0, kWidth_px, kHeight_px);
  std::int64_t frame = 0;
  for (auto _ : state) benchmark::DoNotOptimize(embree.cast(ray_frame(camera, pose(frame++))));
  count_rays(state);
}

void ideal_view(benchmark::State& state) {
  KinectRenderer renderer(living_room());
  const PinholeCamera camera = kinect_camera(525.0, kWidth_px, kHeight_px);
  KinectView view;
  std::int64_t frame = 0;
  for (auto _ : state) {
    renderer.render(pose(frame++), camera, 0.0, kWidth_px, kHeight_px, view);
    benchmark::DoNotOptimize(view.red.data());
  }
  count_rays(state);
}

void kinect(benchmark::State& state, bool registered) {
  SimulatedKinect camera(living_room(), {}, {}, 1);
  RgbdFrame image;
  std::int64_t frame = 0;
  for (auto _ : state) {
    camera.capture(pose(frame), 0.0, frame, {.registered = registered}, image);
    ++frame;
    benchmark::DoNotOptimize(image.color.rgb.data());
  }
  count_rays(state);
}

// The first one is what the others are compared with.
BENCHMARK(bare_embree)->Name("vga/bare_embree/frame")->Unit(benchmark::kMillisecond);
BENCHMARK(ideal_view)->Name("vga/ideal_view/frame")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(kinect, registered, true)
    ->Name("vga/kinect_registered/frame")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(kinect, own_cameras, false)
    ->Name("vga/kinect_two_cameras/frame")
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace roomwise::simulator

BENCHMARK_MAIN();
