#pragma once
#include <optional>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/landmark_svc/core/disparity_table.h"
#include "services/landmark_svc/core/landmark.h"
#include "services/landmark_svc/core/reject_counts.h"
#include "services/landmark_svc/core/scan_lines.h"
#include "services/landmark_svc/core/virtual_scan.h"

namespace roomwise::landmark {

/// What counts as a crease: where two upright planes meet.
struct CreaseParams {
  double side_min_m = 0.05;           ///< straight length needed on either side
  double side_max_m = 0.25;           ///< and looked at
  double angle_min_rad = 0.70;        ///< between the two sides
  double residual_max_quanta = 0.30;  ///< RMS of disparity about either side's line: the sensor's
  double residual_max_m = 0.003;      ///< and, added in squares, how uneven a surface may be
  double bend_min_sigmas = 11.0;      ///< by which the two sides' slopes differ
  double round_better_ratio = 1.5;  ///< a circle's RMS, of the two lines', from which on it is none
  double off_scan_max_m = 0.03;     ///< from the lines' crossing to the scan
  double suppress_px = 14.0;        ///< one crease within so many columns, at 640 px image width
  double position_bias_m = 0.003;   ///< sigma of what does not average out
};

/// Finds creases in a virtual scan: a line (ScanLines) to either side of each point, O(points) by
/// prefix sums; where the two straightest lines around cross is the crease. Its place does not
/// depend on the viewpoint.
///
/// Both sides must be as straight as the sensor's noise lets a plane look, which a step or the foot
/// of something in front is not, and differ in slope by more than that noise can make them. A
/// circle that fits both sides nearly as well as the lines do makes it a round thing, not a crease.
/// With n1, n2 the lines' normals and s1, s2 their sigmas at the crossing, its covariance is
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
  struct Candidate {
    std::size_t at;     ///< index of the scan point
    std::size_t first;  ///< points of both sides: [first, last]
    std::size_t last;
    ScanLine one;
    ScanLine two;
    double misfit_quanta;  ///< RMS of both sides
    Eigen::Vector2d p_m;   ///< the crossing: along and to the left of the camera
  };

  struct Side {
    std::size_t end;  ///< its outermost point
    ScanLine line;
  };

  /// The longest straight side of a crease at `at`; none if it is too short.
  std::optional<Side> side_of(std::size_t at, int step, double residual_max_quanta,
                              const CreaseParams& params, RejectCounts& rejected);
  bool judge(const VirtualScan& scan, std::size_t at, const DisparityTable& table,
             const CreaseParams& params, Candidate& candidate, RejectCounts& rejected);
  bool is_round(const Candidate& candidate, const DisparityTable& table,
                const CreaseParams& params) const;
  void append(const Candidate& candidate, const VirtualScan& scan, const FloorView& floor,
              const PinholeCamera& camera, const DisparityTable& table, const CreaseParams& params,
              std::vector<Landmark>& landmarks) const;

  ScanLines lines_;
  std::vector<Candidate> candidates_;
  /// Of the point looked at last, left and right: neighbours' sides end at nearly the same place.
  std::array<std::size_t, 2> longest_end_{};
};

}  // namespace roomwise::landmark
