#pragma once
#include <embree3/rtcore.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <vector>

#include "services/simulator/core/scene.h"
#include "services/simulator/render/edge_blocks.h"
#include "services/simulator/render/ray_frame.h"
#include "services/simulator/render/surface_table.h"

namespace roomwise::simulator {

/// Number of a triangle that a ray which met nothing is given.
inline constexpr std::uint32_t kNoTriangle = 0xffffffffU;

/// Finds the triangle each pixel sees, by Embree. Which triangle is all that is taken from it:
/// whatever else there is to know of a pixel follows from that triangle's plane in closed form.
class RayCaster {
 public:
  /// Throws std::runtime_error if Embree fails. `table` numbers the triangles of `scene`.
  RayCaster(const Scene& scene, const SurfaceTable& table);

  /// Puts a part of the scene, as `table` counts them, somewhere else; commit() when all are moved.
  /// The world at rest, part 0, must not be moved.
  void move(std::size_t part, const Eigen::Isometry3d& T_world_part);
  void commit();

  /// Triangle numbers of a width x height image, row by row. Blocks of pixels that no edge crosses
  /// are told by the rays of their corners; a pixel there may get another triangle of the same flat
  /// piece. Allocates nothing after the first image of a size.
  void cast(const RayFrame& rays, int width_px, int height_px, std::uint32_t* triangles);

  /// Triangle numbers of pixels [begin, end) of row v, written to triangles[begin..end), not
  /// looking nearer than from_m[u].
  void cast_row(const RayFrame& rays, int v, int begin, int end, const float* from_m,
                std::uint32_t* triangles) const;

 private:
  template <auto release>
  struct Released {
    template <class Handle>
    void operator()(Handle* handle) const {
      release(handle);
    }
  };
  using Device = std::unique_ptr<RTCDeviceTy, Released<rtcReleaseDevice>>;
  using SceneHandle = std::unique_ptr<RTCSceneTy, Released<rtcReleaseScene>>;
  using Geometry = std::unique_ptr<RTCGeometryTy, Released<rtcReleaseGeometry>>;

  SceneHandle build(const std::vector<Mesh>& meshes) const;
  void make_instances();
  RTCScene root() const { return whole_ ? whole_.get() : parts_.front().get(); }
  void number(const RTCHit16& hit, std::uint32_t* triangles) const;
  bool is_asked(int level, int column, int row) const;
  void cast_corners(const RayFrame& rays, int level, int row, int width_px,
                    std::uint32_t* triangles);
  void fill_block(const std::uint32_t* corners, int level, int column, int row, int width_px,
                  std::uint32_t* triangles);
  void cast_tiles(const RayFrame& rays, int width_px, int height_px,
                  std::uint32_t* triangles) const;
  void store(const RTCHit16& hit, int u0, int v0, int width_px, int height_px,
             std::uint32_t* triangles) const;

  const SurfaceTable& table_;
  EdgeBlocks blocks_;
  Device device_;
  std::vector<SceneHandle> parts_;   ///< the world at rest, then one for each walker
  std::vector<Geometry> instances_;  ///< of parts_, unless nothing moves
  SceneHandle whole_;                ///< of instances_; none if nothing moves
};

}  // namespace roomwise::simulator
