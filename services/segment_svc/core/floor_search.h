#pragma once
#include <array>
#include <vector>

#include "services/segment_svc/core/floor_plane.h"
#include "services/segment_svc/core/floor_points.h"

namespace roomwise::segment {

/// Where a floor may be looked for.
struct FloorLimits {
  double camera_height_min_m = 0.10;
  double camera_height_max_m = 2.00;
  double tilt_max_rad = 0.26;  ///< between its normal and the mounting's
};

/// Looks for the floor over all allowed heights and tilts, when nothing is known of it but the
/// mounting's rough tilt.
///
/// For each tilt of a grid one histogram of the points' depths below the camera gives, for all
/// heights at once, the votes: points within 6 cm of the plane, minus points up to 12 cm above
/// those. On a wall the two cancel. A plane with more than a tenth as many points beneath it as on
/// it is none. What is left are horizontal surfaces, and the floor is the lowest.
class FloorSearch {
 public:
  explicit FloorSearch(const FloorLimits& limits) : limits_(limits) {}

  /// Starting planes for a refinement, lowest first, at least 10 cm apart.
  const std::vector<FloorPlane>& search(const std::vector<FloorPoint>& points,
                                        const FloorPlane& mounted);

 private:
  static constexpr int kBins = 176;  // of 2 cm: down to 3.5 m below the camera
  struct Best {
    int votes = 0;
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  };
  void try_tilt(const std::vector<FloorPoint>& points, const Eigen::Vector3d& normal);
  int up_to(int bin) const;
  void collect(std::size_t point_count);

  FloorLimits limits_;
  std::array<int, kBins> below_{};  // points at most this far below the camera
  std::array<Best, kBins> best_of_height_{};
  std::vector<FloorPlane> found_;
};

}  // namespace roomwise::segment
