#pragma once
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/landmark_svc/core/disparity_table.h"
#include "services/landmark_svc/core/landmark.h"
#include "services/landmark_svc/core/reject_counts.h"
#include "services/landmark_svc/core/virtual_scan.h"

namespace roomwise::landmark {

/// What counts as a crease: where two upright planes meet.
struct CreaseParams {
  double side_min_m = 0.12;        ///< straight length needed on either side
  double side_max_m = 0.25;        ///< and looked at
  double angle_min_rad = 0.70;     ///< between the two sides
  double residual_max_m = 0.006;   ///< RMS about either side's line, plus half a quantum
  double off_scan_max_m = 0.03;    ///< from the lines' crossing to the scan
  double suppress_px = 14.0;       ///< one crease within so many columns, at 640 px image width
  double position_bias_m = 0.010;  ///< sigma of what does not average out
};

/// Finds creases in a virtual scan: to either side of each point a total-least-squares line, by
/// prefix sums, so O(points); the crossing of the two straightest lines around is the crease. Its
/// place does not depend on the viewpoint.
///
/// A round thing bends within each side too: what turns there by half of the angle is no crease.
/// With n1, n2 the lines' normals and s1, s2 their sigmas, the covariance of the crossing is
/// (n1 n1' / s1^2 + n2 n2' / s2^2)^-1.
class CreaseFinder {
 public:
  /// Makes room for scans of so many points: find() allocates nothing then.
  void reserve(std::size_t points);
  /// Appends creases to `landmarks`.
  void find(const VirtualScan& scan, const FloorView& floor, const PinholeCamera& camera,
            const DisparityTable& table, int width_px, const CreaseParams& params,
            std::vector<Landmark>& landmarks, RejectCounts& rejected);

 private:
  struct Sums {  // over the points before, about the scan's first
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  };
  struct Line {
    Eigen::Vector2d mean_m;
    Eigen::Vector2d along;  ///< unit
    double rms_m;
    double points;
  };
  struct Candidate {
    std::size_t at;   ///< index of the scan point
    double misfit_m;  ///< RMS of both sides
    bool is_convex;
    Eigen::Vector2d p_robot_m;
    Eigen::Matrix2d covariance_m2;
    double angle_rad;
    std::size_t first;  ///< points of both sides: [first, last]
    std::size_t last;
  };

  void prepare(const std::vector<ScanPoint>& points, const DisparityTable& table);
  Line line_of(std::size_t begin, std::size_t end) const;
  double bend_rad(std::size_t begin, std::size_t end) const;
  bool judge(const VirtualScan& scan, std::size_t at, const DisparityTable& table,
             const CreaseParams& params, Candidate& candidate, RejectCounts& rejected) const;
  std::size_t reach(const std::vector<ScanPoint>& points, std::size_t from, int step,
                    double length_m) const;

  std::vector<Sums> sums_;
  std::vector<std::uint32_t> piece_;  ///< of each point: which unbroken piece of the scan
  std::vector<Candidate> candidates_;
};

}  // namespace roomwise::landmark
