#pragma once
#include <vector>

#include "services/simulator/core/scene.h"
#include "services/simulator/render/ray_frame.h"
#include "services/simulator/render/surface_table.h"

namespace roomwise::simulator {

/// Images of one row, as KinectView has them; all begin at column 0.
struct ViewRow {
  float* inverse_depth_per_m;
  float* infrared_ratio;
  float* red;
  float* green;
  float* blue;
};

/// Pixels [begin, end) of row v, all on the same surface.
struct Run {
  int v;
  int begin;
  int end;
};

/// Fills runs of pixels from the plane of the surface they show. On a plane 1 / depth is linear in
/// the pixel, and so are texture coordinate / depth and cosine * range / depth: the inner loops are
/// a few sums and products, and every pixel is exact. Light of a lamp at distance r falls as
/// cos / (1 + r^2), r in metres.
class RunShading {
 public:
  /// `scene` must outlive it.
  explicit RunShading(const Scene& scene);

  /// Makes room for runs of that many pixels.
  void resize(int width_px);

  /// Depth and infrared light. False, with nothing() there, if the plane goes through
  /// the eye.
  [[nodiscard]] bool depth(const RayFrame& rays, const Surface& surface, const Run& run,
                           const ViewRow& row);

  /// Colour of the run that depth() filled last.
  void color(const RayFrame& rays, const Surface& surface, const Run& run, const ViewRow& row);

  /// What is seen where nothing is.
  void nothing(const Run& run, const ViewRow& row) const;

 private:
  void find_places(const RayFrame& rays, const Surface& surface, const Run& run);
  void light(const RayFrame& rays, const Surface& surface, const Run& run,
             const ViewRow& row) const;

  const Scene& scene_;
  std::vector<float> depth_m_, s_, t_, s_width_, t_width_, mix_;  ///< of the run in hand
};

}  // namespace roomwise::simulator
