#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "services/landmark_svc/core/disparity_table.h"
#include "services/landmark_svc/core/virtual_scan.h"

namespace roomwise::landmark {

/// An upright plane as a virtual scan shows it. With r a point's distance along the level viewing
/// direction, l to its left, x = l / r and Q = 8 f b, its disparity is linear in x:
///
///   D = Q / r = quanta + slope x   <=>   quanta r + slope l = Q
///
/// A Kinect's noise is uniform in D, so a plain least-squares line in (x, D) weighs every point as
/// it deserves: by 1 / r^4 in metres.
struct ScanLine {
  double quanta = 0.0;      ///< D at x = 0
  double slope = 0.0;       ///< quanta
  double rms_quanta = 0.0;  ///< of the points about it
  double points = 0.0;
  double mean_ratio = 0.0;       ///< of x
  double variance_ratio2 = 0.0;  ///< of x

  /// Normal of the plane (along, left), not of unit length.
  Eigen::Vector2d normal() const { return {quanta, slope}; }
  /// Distance of a place (along, left) [m] from it, positive beyond.
  double distance_m(const Eigen::Vector2d& p_m, double quanta_m) const {
    return (normal().dot(p_m) - quanta_m) / normal().norm();
  }
  /// Variance of the slope if a point's sigma is `sigma_quanta`. Neighbours' noise goes together:
  /// more than 9 tell no more.
  double slope_variance(double sigma_quanta) const;
  /// Likewise of D at x.
  double variance_at(double ratio, double sigma_quanta) const;
};

/// The straight pieces of a scan, by prefix sums: any line in O(1).
class ScanLines {
 public:
  /// Makes room for scans of so many points: prepare() allocates nothing then.
  void reserve(std::size_t points);
  /// Looks at a scan and cuts it where neighbours are more than 6 cm and 3 quanta or 4 columns
  /// apart.
  void prepare(const VirtualScan& scan, const DisparityTable& table);

  /// Through points [begin, end), at least two.
  ScanLine line(std::size_t begin, std::size_t end) const;
  /// The last point in direction `step` (-1 or 1) of the unbroken piece that holds `from`, not
  /// farther than `length_m` from it. Looked for from point `about` on: quick if the answer is
  /// near.
  std::size_t reach(std::size_t from, int step, double length_m, std::size_t about) const;
  /// Along and left of the camera.
  const Eigen::Vector2d& p_m(std::size_t at) const { return points_m_[at]; }

 private:
  struct Sums {  // over the points before
    double n = 0.0, x = 0.0, d = 0.0, xx = 0.0, xd = 0.0, dd = 0.0;
  };
  std::vector<Sums> sums_;
  std::vector<Eigen::Vector2d> points_m_;
  std::vector<std::uint32_t> piece_;  ///< of each point: which unbroken piece of the scan
};

/// RMS distance of points [first, last] from the circle that fits them best; infinite where none
/// does (less than four points, or all on a line).
double circle_rms_m(const ScanLines& scan, std::size_t first, std::size_t last);

}  // namespace roomwise::landmark
