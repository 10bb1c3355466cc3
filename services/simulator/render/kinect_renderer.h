#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/simulator/core/kinect/kinect_view.h"
#include "services/simulator/core/scene.h"
#include "services/simulator/render/ray_caster.h"
#include "services/simulator/render/run_shading.h"
#include "services/simulator/render/surface_table.h"

namespace roomwise::simulator {

/// Makes the ideal images of a scene: depth, infrared light, colour, class and material by pixel.
///
/// Embree says which triangle a pixel shows; rows are then cut into runs of the same triangle and
/// each run is filled in closed form from the triangle's plane. Pixels of a mirror are cast again
/// from the mirror image of the camera, pixels of window glass again from behind the pane.
/// Allocates nothing after the first image of a size, but for what Embree does to move walkers. One
/// instance, one thread.
class KinectRenderer {
 public:
  /// `scene` must outlive it. Throws std::runtime_error if a mesh is broken or Embree fails.
  explicit KinectRenderer(const Scene& scene);

  /// The view of one camera for both depth and colour, as registered images have it, `t_s` after
  /// the start. T_world_camera: camera frame z forward, x right, y down.
  void render(const Eigen::Isometry3d& T_world_camera, const PinholeCamera& camera, double t_s,
              int width_px, int height_px, KinectView& out);

  /// As render(), but colour from another camera than everything else.
  void render(const Eigen::Isometry3d& T_world_camera, const PinholeCamera& camera,
              const Eigen::Isometry3d& T_world_color, const PinholeCamera& color_camera, double t_s,
              int width_px, int height_px, KinectView& out);

 private:
  enum class Wanted { kBoth, kDepth, kColor };
  /// What one more ray behind glass or off a mirror needs, a row of each.
  struct Level {
    std::vector<std::uint32_t> triangles;
    std::vector<float> from_m;
    std::vector<float> planes[5];
    ViewRow row();
  };

  void make_room(int width_px, int height_px, KinectView& out);
  void move_walkers(double t_s);
  void cast_and_shade(const RayFrame& rays, Wanted wanted, KinectView& out);
  void name_surface(const Run& run, std::uint32_t triangle, KinectView& out) const;
  void shade_run(const RayFrame& rays, const Run& run, std::uint32_t triangle, Wanted wanted,
                 std::size_t level, const ViewRow& row);
  void look_on(const RayFrame& rays, const Run& run, const Surface& surface, Wanted wanted,
               std::size_t level, const ViewRow& row);

  const Scene& scene_;
  SurfaceTable surfaces_;
  RayCaster caster_;
  RunShading shading_;
  int width_px_ = 0;
  std::vector<std::uint32_t> triangles_;  ///< of the image, height x width
  std::vector<Level> levels_;
};

/// The simulated Kinect's pinhole model for an image `width_px` wide and 3/4 of it high; `focal_px`
/// is for 640. The principal point is half the width and height, as OpenNI has it.
PinholeCamera kinect_camera(double focal_px, int width_px, int height_px);

}  // namespace roomwise::simulator
