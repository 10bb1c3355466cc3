#include "services/simulator/render/ray_caster.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace roomwise::simulator {
namespace {

constexpr int kLanes = 16;
constexpr int kTile_px = 4;  // a packet is a tile of 4 x 4: its rays meet the same few triangles

[[noreturn]] void fail(RTCDevice device) {
  throw std::runtime_error("Embree failed, error " + std::to_string(rtcGetDeviceError(device)));
}

RTCRayHit16 empty_packet(const Eigen::Vector3d& origin_m) {
  RTCRayHit16 packet;
  const Eigen::Vector3f origin = origin_m.cast<float>();
  std::fill_n(packet.ray.org_x, kLanes, origin.x());
  std::fill_n(packet.ray.org_y, kLanes, origin.y());
  std::fill_n(packet.ray.org_z, kLanes, origin.z());
  std::fill_n(packet.ray.time, kLanes, 0.0F);
  std::fill_n(packet.ray.mask, kLanes, ~0U);
  std::fill_n(packet.ray.flags, kLanes, 0U);
  std::fill_n(packet.ray.id, kLanes, 0U);
  return packet;
}

void reset_hits(RTCRayHit16& packet) {
  std::fill_n(packet.ray.tfar, kLanes, std::numeric_limits<float>::infinity());
  std::fill_n(packet.hit.geomID, kLanes, RTC_INVALID_GEOMETRY_ID);
  std::fill_n(packet.hit.instID[0], kLanes, RTC_INVALID_GEOMETRY_ID);
}

/// Directions of a 4 x 4 tile relative to that of its first pixel, lane by lane.
struct TileSteps {
  alignas(64) float x[kLanes], y[kLanes], z[kLanes];

  explicit TileSteps(const RayFrame& rays) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const Eigen::Vector3f step =
          (lane % kTile_px * rays.step_u + lane / kTile_px * rays.step_v).cast<float>();
      x[lane] = step.x(), y[lane] = step.y(), z[lane] = step.z();
    }
  }
};

void set_directions(const Eigen::Vector3f& first, const TileSteps& steps, RTCRayHit16& packet) {
  for (int lane = 0; lane < kLanes; ++lane) packet.ray.dir_x[lane] = first.x() + steps.x[lane];
  for (int lane = 0; lane < kLanes; ++lane) packet.ray.dir_y[lane] = first.y() + steps.y[lane];
  for (int lane = 0; lane < kLanes; ++lane) packet.ray.dir_z[lane] = first.z() + steps.z[lane];
}

RTCIntersectContext context_of(RTCIntersectContextFlags coherence) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = coherence;
  return context;
}

template <class Element>
Element* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
  return static_cast<Element*>(
      rtcSetNewGeometryBuffer(geometry, type, 0, format, 3 * sizeof(Element), count));
}

void fill(RTCGeometry geometry, const Mesh& mesh) {
  auto* corner =
      new_buffer<float>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.corners_m.size());
  for (const auto& p_m : mesh.corners_m) corner = std::copy_n(p_m.data(), 3, corner);
  auto* index = new_buffer<std::uint32_t>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3,
                                          mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) index = std::copy_n(triangle.data(), 3, index);
}

}  // namespace

RayCaster::RayCaster(const Scene& scene, const SurfaceTable& table)
    : table_(table), device_(rtcNewDevice("threads=1")) {
  if (!device_) fail(nullptr);
  parts_.push_back(build(scene.meshes));
  first_mesh_.push_back(0);
  for (std::size_t i = 0; i < scene.walkers.size(); ++i) {
    parts_.push_back(build(scene.walkers[i].meshes));
    first_mesh_.push_back(table.first_mesh_of_walker(i));
  }
  if (parts_.size() > 1) make_instances();
}

RayCaster::SceneHandle RayCaster::build(const std::vector<Mesh>& meshes) const {
  SceneHandle scene(rtcNewScene(device_.get()));
  // Robust: no ray slips through between two triangles that share an edge.
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
    if (!meshes[i].triangles.empty()) fill(geometry.get(), meshes[i]);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometryByID(scene.get(), geometry.get(), static_cast<unsigned>(i));
  }
  rtcCommitScene(scene.get());
  if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) fail(device_.get());
  return scene;
}

void RayCaster::make_instances() {
  whole_.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(whole_.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    instances_.emplace_back(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(instances_.back().get(), parts_[i].get());
    rtcAttachGeometryByID(whole_.get(), instances_.back().get(), static_cast<unsigned>(i));
    place(i, Eigen::Isometry3d::Identity());
  }
  commit();
}

void RayCaster::place(std::size_t part, const Eigen::Isometry3d& T_world_part) {
  const Eigen::Matrix<float, 3, 4> columns = T_world_part.matrix().topRows<3>().cast<float>();
  rtcSetGeometryTransform(instances_[part].get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                          columns.data());
  rtcCommitGeometry(instances_[part].get());
}

void RayCaster::move_walker(std::size_t walker, const Eigen::Isometry3d& T_world_walker) {
  place(1 + walker, T_world_walker);
}

void RayCaster::commit() {
  if (whole_) rtcCommitScene(whole_.get());
}

std::uint32_t RayCaster::triangle(const RTCRayHit16& packet, int lane) const {
  const unsigned geometry = packet.hit.geomID[lane];
  if (geometry == RTC_INVALID_GEOMETRY_ID) return kNoTriangle;
  const std::size_t part = whole_ ? packet.hit.instID[0][lane] : 0;
  return table_.first_of_mesh(first_mesh_[part] + geometry) + packet.hit.primID[lane];
}

void RayCaster::cast(const RayFrame& rays, int width_px, int height_px,
                     std::uint32_t* triangles) const {
  RTCIntersectContext context = context_of(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
  const TileSteps steps(rays);
  RTCRayHit16 packet = empty_packet(rays.origin_m);
  std::fill_n(packet.ray.tnear, kLanes, 0.0F);
  alignas(64) int valid[kLanes];
  for (int v = 0; v < height_px; v += kTile_px) {
    for (int u = 0; u < width_px; u += kTile_px) {
      for (int lane = 0; lane < kLanes; ++lane) {
        valid[lane] = u + lane % kTile_px < width_px && v + lane / kTile_px < height_px ? -1 : 0;
      }
      set_directions(rays.direction(u, v).cast<float>(), steps, packet);
      reset_hits(packet);
      rtcIntersect16(valid, root(), &context, &packet);
      for (int lane = 0; lane < kLanes; ++lane) {
        if (valid[lane] == 0) continue;
        triangles[(v + lane / kTile_px) * width_px + u + lane % kTile_px] = triangle(packet, lane);
      }
    }
  }
}

void RayCaster::cast_row(const RayFrame& rays, int v, int begin, int end, const float* from_m,
                         std::uint32_t* triangles) const {
  RTCIntersectContext context = context_of(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
  RTCRayHit16 packet = empty_packet(rays.origin_m);
  alignas(64) int valid[kLanes];
  for (int u = begin; u < end; u += kLanes) {
    for (int lane = 0; lane < kLanes; ++lane) {
      valid[lane] = u + lane < end ? -1 : 0;
      const Eigen::Vector3f direction = rays.direction(u + lane, v).cast<float>();
      packet.ray.dir_x[lane] = direction.x();
      packet.ray.dir_y[lane] = direction.y();
      packet.ray.dir_z[lane] = direction.z();
      packet.ray.tnear[lane] = from_m[std::min(u + lane, end - 1)];
    }
    reset_hits(packet);
    rtcIntersect16(valid, root(), &context, &packet);
    for (int lane = 0; u + lane < end && lane < kLanes; ++lane) {
      triangles[u + lane] = triangle(packet, lane);
    }
  }
}

}  // namespace roomwise::simulator
