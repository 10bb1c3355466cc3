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

/// Where every pixel has to be looked at, rays go out as packets of one tile: they meet the same
/// few triangles.
constexpr int kTile_px = EdgeBlocks::side_px(EdgeBlocks::kFinest);
static_assert(kTile_px * kTile_px == kLanes);

/// Directions of a tile's rays relative to that of its first pixel.
struct TileSteps {
  alignas(64) float x[kLanes], y[kLanes], z[kLanes];

  explicit TileSteps(const RayFrame& rays) {
    for (int i = 0; i < kLanes; ++i) {
      const Eigen::Vector3f step =
          (i % kTile_px * rays.step_u + i / kTile_px * rays.step_v).cast<float>();
      x[i] = step.x(), y[i] = step.y(), z[i] = step.z();
    }
  }
};

void set_directions(const Eigen::Vector3f& first, const TileSteps& steps, RTCRayHit16& packet) {
  for (int i = 0; i < kLanes; ++i) packet.ray.dir_x[i] = first.x() + steps.x[i];
  for (int i = 0; i < kLanes; ++i) packet.ray.dir_y[i] = first.y() + steps.y[i];
  for (int i = 0; i < kLanes; ++i) packet.ray.dir_z[i] = first.z() + steps.z[i];
  reset_hits(packet);
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
  for (int level = 0; level < EdgeBlocks::kLevels; ++level) {
    for (int row = 0; row < blocks_.rows(level); ++row) {
      cast_corners(rays, level, row, width_px, triangles);
    }
  }
  cast_tiles(rays, width_px, height_px, triangles);
}

/// Whether the corners of a block may tell all of it, and those of a larger one have not.
bool RayCaster::is_asked(int level, int column, int row) const {
  return !blocks_.has_edge(level, column, row) &&
         (level == 0 || blocks_.has_edge(level - 1, column / 2, row / 2));
}

void RayCaster::cast_corners(const RayFrame& rays, int level, int row, int width_px,
                             std::uint32_t* triangles) {
  constexpr int kCorners = 4;
  const int side_px = EdgeBlocks::side_px(level);
  RTCIntersectContext context = context_of(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
  RTCRayHit16 packet = empty_packet(rays.origin_m);
  alignas(64) int valid[kLanes];
  int column = 0;
  while (column < blocks_.columns(level)) {
    int columns[kLanes / kCorners];
    int count = 0;
    for (; column < blocks_.columns(level) && count < kLanes / kCorners; ++column) {
      if (is_asked(level, column, row)) columns[count++] = column;
    }
    if (count == 0) return;
    for (int i = 0; i < kLanes; ++i) {
      const int block = std::min(i / kCorners, count - 1);
      valid[i] = i / kCorners < count ? -1 : 0;
      const int u = columns[block] * side_px + (i & 1) * (side_px - 1);
      const int v = row * side_px + (i >> 1 & 1) * (side_px - 1);
      set_direction(rays.direction(u, v), i, packet);
    }
    reset_hits(packet);
    rtcIntersect16(valid, root(), &context, &packet);
    std::uint32_t numbers[kLanes];
    number(packet.hit, numbers);
    for (int i = 0; i < count; ++i) {
      fill_block(numbers + i * kCorners, level, columns[i], row, width_px, triangles);
    }
  }
}

void RayCaster::fill_block(const std::uint32_t* corners, int level, int column, int row,
                           int width_px, std::uint32_t* triangles) {
  const auto piece = [this](std::uint32_t triangle) {
    return triangle == kNoTriangle ? kNoTriangle : table_.flat_piece(triangle);
  };
  const std::uint32_t first = piece(corners[0]);
  for (int i = 1; i < 4; ++i) {
    if (piece(corners[i]) != first) return blocks_.add_edge(level, column, row);
  }
  const int side_px = EdgeBlocks::side_px(level);
  std::uint32_t* to = triangles + row * side_px * width_px + column * side_px;
  for (int v = 0; v < side_px; ++v) std::fill_n(to + v * width_px, side_px, corners[0]);
}

void RayCaster::cast_tiles(const RayFrame& rays, int width_px, int height_px,
                           std::uint32_t* triangles) const {
  alignas(64) static constexpr int kAll[kLanes] = {-1, -1, -1, -1, -1, -1, -1, -1,
                                                   -1, -1, -1, -1, -1, -1, -1, -1};
  constexpr int kLevel = EdgeBlocks::kFinest;
  RTCIntersectContext context = context_of(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
  const TileSteps steps(rays);
  RTCRayHit16 packet = empty_packet(rays.origin_m);
  for (int row = 0; row < blocks_.rows(kLevel); ++row) {
    for (int column = 0; column < blocks_.columns(kLevel); ++column) {
      if (!blocks_.has_edge(kLevel, column, row)) continue;
      const int u = column * kTile_px, v = row * kTile_px;
      set_directions(rays.direction(u, v).cast<float>(), steps, packet);
      rtcIntersect16(kAll, root(), &context, &packet);
      store(packet.hit, u, v, width_px, height_px, triangles);
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
