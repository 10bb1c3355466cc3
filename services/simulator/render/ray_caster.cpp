#include "services/simulator/render/ray_caster.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace roomwise::simulator {
namespace {

constexpr int kLanes = 16;
[[noreturn]] void fail(RTCError error) {
  throw std::runtime_error("Embree failed with error " + std::to_string(error));
}

RTCRayHit16 empty_packet(const Eigen::Vector3d& origin_m) {
  RTCRayHit16 packet;
  const Eigen::Vector3f origin = origin_m.cast<float>();
  std::fill_n(packet.ray.org_x, kLanes, origin.x());
  std::fill_n(packet.ray.org_y, kLanes, origin.y());
  std::fill_n(packet.ray.org_z, kLanes, origin.z());
  std::fill_n(packet.ray.tnear, kLanes, 0.0F);
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

/// Rays go out in square blocks, as packets of 4 x 4 pixels that Embree takes on together: they
/// meet the same few triangles.
constexpr int kTile_px = 4;
constexpr int kBlock_px = EdgeBlocks::kSide_px;
constexpr int kPackets = kBlock_px * kBlock_px / kLanes;

/// Where ray i of a block is in it.
constexpr int block_column(int i) { return i / kLanes % 2 * kTile_px + i % kTile_px; }
constexpr int block_row(int i) { return i / kLanes / 2 * kTile_px + i % kLanes / kTile_px; }

struct RayBlock {
  RTCRayHit16 packets[kPackets];
};

/// Directions of a block's rays relative to that of its first pixel.
struct RayBlockSteps {
  alignas(64) float x[kPackets][kLanes], y[kPackets][kLanes], z[kPackets][kLanes];

  explicit RayBlockSteps(const RayFrame& rays) {
    for (int i = 0; i < kPackets * kLanes; ++i) {
      const Eigen::Vector3f step =
          (block_column(i) * rays.step_u + block_row(i) * rays.step_v).cast<float>();
      const int packet = i / kLanes, lane = i % kLanes;
      x[packet][lane] = step.x(), y[packet][lane] = step.y(), z[packet][lane] = step.z();
    }
  }
};

void set_directions(const Eigen::Vector3f& first, const RayBlockSteps& steps, RayBlock& block) {
  for (int k = 0; k < kPackets; ++k) {
    RTCRayHit16& packet = block.packets[k];
    for (int i = 0; i < kLanes; ++i) packet.ray.dir_x[i] = first.x() + steps.x[k][i];
    for (int i = 0; i < kLanes; ++i) packet.ray.dir_y[i] = first.y() + steps.y[k][i];
    for (int i = 0; i < kLanes; ++i) packet.ray.dir_z[i] = first.z() + steps.z[k][i];
    reset_hits(packet);
  }
}

void set_direction(const Eigen::Vector3d& way, int lane, RTCRayHit16& packet) {
  packet.ray.dir_x[lane] = static_cast<float>(way.x());
  packet.ray.dir_y[lane] = static_cast<float>(way.y());
  packet.ray.dir_z[lane] = static_cast<float>(way.z());
}

RTCIntersectContext context_of(RTCIntersectContextFlags coherence) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = coherence;
  return context;
}

/// New memory of a geometry for `count` triples.
template <class Element>
Element* triples(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
  return static_cast<Element*>(
      rtcSetNewGeometryBuffer(geometry, type, 0, format, 3 * sizeof(Element), count));
}

/// All meshes as one geometry: triangles are numbered as SurfaceTable numbers them.
void fill(RTCGeometry geometry, const std::vector<Mesh>& meshes) {
  std::size_t corners = 0, triangles = 0;
  for (const Mesh& mesh : meshes) {
    corners += mesh.corners_m.size();
    triangles += mesh.triangles.size();
  }
  if (triangles == 0) return;
  auto* corner = triples<float>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, corners);
  auto* index =
      triples<std::uint32_t>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, triangles);
  std::uint32_t first = 0;
  for (const Mesh& mesh : meshes) {
    for (const auto& p_m : mesh.corners_m) corner = std::copy_n(p_m.data(), 3, corner);
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t i : triangle) *index++ = first + i;
    }
    first += static_cast<std::uint32_t>(mesh.corners_m.size());
  }
}

}  // namespace

RayCaster::RayCaster(const Scene& scene, const SurfaceTable& table)
    : table_(table), blocks_(scene, table), device_(rtcNewDevice("threads=1")) {
  if (!device_) fail(rtcGetDeviceError(nullptr));
  parts_.push_back(build(scene.meshes));
  for (const Walker& walker : scene.walkers) parts_.push_back(build(walker.meshes));
  if (parts_.size() > 1) make_instances();
}

RayCaster::SceneHandle RayCaster::build(const std::vector<Mesh>& meshes) const {
  SceneHandle scene(rtcNewScene(device_.get()));
  // Robust: no ray slips through between two triangles that share an edge.
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  const Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE));
  fill(geometry.get(), meshes);
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(scene.get(), geometry.get(), 0);
  rtcCommitScene(scene.get());
  if (const RTCError error = rtcGetDeviceError(device_.get())) fail(error);
  return scene;
}

void RayCaster::make_instances() {
  whole_.reset(rtcNewScene(device_.get()));
  rtcSetSceneFlags(whole_.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    instances_.emplace_back(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
    rtcSetGeometryInstancedScene(instances_.back().get(), parts_[i].get());
    rtcAttachGeometryByID(whole_.get(), instances_.back().get(), static_cast<unsigned>(i));
    move(i, Eigen::Isometry3d::Identity());
  }
  commit();
}

void RayCaster::move(std::size_t part, const Eigen::Isometry3d& T_world_part) {
  blocks_.move(part, T_world_part);
  const Eigen::Matrix<float, 3, 4> columns = T_world_part.matrix().topRows<3>().cast<float>();
  rtcSetGeometryTransform(instances_[part].get(), 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR,
                          columns.data());
  rtcCommitGeometry(instances_[part].get());
}

void RayCaster::commit() {
  if (whole_) rtcCommitScene(whole_.get());
}

void RayCaster::number(const RTCHit16& hit, std::uint32_t* triangles) const {
  for (int i = 0; i < kLanes; ++i) {
    triangles[i] = hit.geomID[i] == RTC_INVALID_GEOMETRY_ID ? kNoTriangle : hit.primID[i];
  }
  if (!whole_) return;
  for (int i = 0; i < kLanes; ++i) {
    if (triangles[i] != kNoTriangle) triangles[i] += table_.first_of_part(hit.instID[0][i]);
  }
}

void RayCaster::store(const RTCHit16& hit, int u0, int v0, int width_px, int height_px,
                      std::uint32_t* triangles) const {
  std::uint32_t numbers[kLanes];
  number(hit, numbers);
  const int columns = std::clamp(width_px - u0, 0, kTile_px);
  const int rows = std::clamp(height_px - v0, 0, kTile_px);
  for (int i = 0; i < rows; ++i) {
    std::copy_n(numbers + kTile_px * i, columns, triangles + (v0 + i) * width_px + u0);
  }
}

void RayCaster::cast(const RayFrame& rays, int width_px, int height_px, std::uint32_t* triangles) {
  blocks_.mark(rays, width_px, height_px);
  for (int row = 0; row < blocks_.rows(); ++row) cast_corners(rays, row, width_px, triangles);
  cast_blocks(rays, width_px, height_px, triangles);
}

void RayCaster::cast_corners(const RayFrame& rays, int row, int width_px,
                             std::uint32_t* triangles) {
  constexpr int kCorners = 4, kReach_px = EdgeBlocks::kSide_px - 1;
  RTCIntersectContext context = context_of(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
  RTCRayHit16 packet = empty_packet(rays.origin_m);
  alignas(64) int valid[kLanes];
  int column = 0;
  while (column < blocks_.columns()) {
    int columns[kLanes / kCorners];
    int count = 0;
    for (; column < blocks_.columns() && count < kLanes / kCorners; ++column) {
      if (!blocks_.has_edge(column, row)) columns[count++] = column;
    }
    if (count == 0) return;
    for (int i = 0; i < kLanes; ++i) {
      const int block = std::min(i / kCorners, count - 1);
      valid[i] = i / kCorners < count ? -1 : 0;
      const int u = columns[block] * EdgeBlocks::kSide_px + (i & 1) * kReach_px;
      const int v = row * EdgeBlocks::kSide_px + (i >> 1 & 1) * kReach_px;
      set_direction(rays.direction(u, v), i, packet);
    }
    reset_hits(packet);
    rtcIntersect16(valid, root(), &context, &packet);
    std::uint32_t numbers[kLanes];
    number(packet.hit, numbers);
    for (int i = 0; i < count; ++i) {
      fill_block(numbers + i * kCorners, columns[i], row, width_px, triangles);
    }
  }
}

void RayCaster::fill_block(const std::uint32_t* corners, int column, int row, int width_px,
                           std::uint32_t* triangles) {
  const auto piece = [this](std::uint32_t triangle) {
    return triangle == kNoTriangle ? kNoTriangle : table_.flat_piece(triangle);
  };
  const std::uint32_t first = piece(corners[0]);
  for (int i = 1; i < 4; ++i) {
    if (piece(corners[i]) != first) return blocks_.add_edge(column, row);
  }
  constexpr int kSide_px = EdgeBlocks::kSide_px;
  std::uint32_t* to = triangles + row * kSide_px * width_px + column * kSide_px;
  for (int v = 0; v < kSide_px; ++v) std::fill_n(to + v * width_px, kSide_px, corners[0]);
}

void RayCaster::cast_blocks(const RayFrame& rays, int width_px, int height_px,
                            std::uint32_t* triangles) const {
  RTCIntersectContext context = context_of(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
  const RayBlockSteps steps(rays);
  RayBlock block;
  for (RTCRayHit16& packet : block.packets) packet = empty_packet(rays.origin_m);
  for (int row = 0; row < blocks_.rows(); ++row) {
    for (int column = 0; column < blocks_.columns(); ++column) {
      if (!blocks_.has_edge(column, row)) continue;
      const int u = column * kBlock_px, v = row * kBlock_px;
      set_directions(rays.direction(u, v).cast<float>(), steps, block);
      rtcIntersectNM(root(), &context, reinterpret_cast<RTCRayHitN*>(block.packets), kLanes,
                     kPackets, sizeof(RTCRayHit16));
      for (int k = 0; k < kPackets; ++k) {
        store(block.packets[k].hit, u + block_column(k * kLanes), v + block_row(k * kLanes),
              width_px, height_px, triangles);
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
      set_direction(rays.direction(u + lane, v), lane, packet);
      packet.ray.tnear[lane] = from_m[std::min(u + lane, end - 1)];
    }
    reset_hits(packet);
    rtcIntersect16(valid, root(), &context, &packet);
    std::uint32_t numbers[kLanes];
    number(packet.hit, numbers);
    std::copy_n(numbers, std::min(kLanes, end - u), triangles + u);
  }
}

}  // namespace roomwise::simulator
