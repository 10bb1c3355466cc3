#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/geometry/pose2.h"
#include "services/safety_svc/core/instant.h"
#include "services/safety_svc/core/reason.h"

namespace roomwise::safety {

/// What a place is known to be.
enum class Ground : std::uint8_t {
  kUnknown,     ///< never seen, or in doubt since
  kOverlooked,  ///< floor was seen behind it; something low may stand there
  kFree,        ///< floor was seen there
  kClosed,      ///< not to be entered
};

/// A place as it is remembered.
struct Place {
  Ground ground = Ground::kUnknown;
  Reason why = Reason::kUnknown;  ///< of a closed or unknown one
};

/// How far the way is free along some bearings, seen from the robot frame's origin.
struct FreeView {
  double first_bearing_rad = 0.0;
  double bearing_step_rad = 0.0;
  std::span<const double> free_range_m;
  std::span<const double> unknown_ratio;     ///< as many
  std::span<const double> obstacle_range_m;  ///< as many; to what is seen to stand there; 0: none
  double floor_seen_from_m = 0.0;            ///< straight ahead; nearer is the blind zone
  bool has_drop_off = false;                 ///< some of what ends the view is an edge to fall off
};

/// What the floor round the robot is like, in cells of 5 cm of the odom frame: what was seen free,
/// and what was seen to end there, kept while the robot drives and the camera no longer sees it.
///
/// Along each bearing with free range f, in view from s on:
///   - s .. f is free, f and the cell behind it closed, what lies farther as it was;
///   - nearer than s, where nothing is known, is overlooked: rays pass above it;
///   - f < s: the floor came not into view. What stands there is no nearer than a Kinect measures
///     and no farther than s: from where something is seen to stand on that is unknown again, and
///     what lies before it is as in the blind zone. If nothing is seen to, all of it is unknown
///     again, or, before something closed that explains the view, overlooked.
///   - f < s, and most pixels have no reading, over a wider angle than shadows have: anything may
///     stand anywhere. All of it is unknown again, from the room the robot itself takes up on; but
///     before something closed too near to be measured, which is what a robot sees that turns
///     toward a wall beside it, overlooked.
/// No floor in view says nothing for three bearings at either edge of what was ever in view: there
/// pixels come and go.
/// At the edges of each view, where bearings are in view in part, nothing is closed. Only seeing
/// the floor opens what was closed. Free fades to overlooked, closed to unknown.
///
/// Cells are a torus of fixed size: what is 6.4 m apart shares one, and the newer place wins.
class ObstacleMemory {
 public:
  static constexpr double kCell_m = 0.05;
  static constexpr double kReach_m = 2.5;  ///< bearings are written no farther

  ObstacleMemory();

  /// Forgets everything: a new odom frame.
  void forget();

  /// Takes up what was seen from `T_odom_robot` by a robot that takes up a circle of `own_m`, its
  /// margin included: what is that near is in doubt only together with what lies behind it. False,
  /// and nothing changed, if the view's numbers are no view: counts that differ, none or more than
  /// 1000, or anything not finite.
  [[nodiscard]] bool see(const Instant& now, const Pose2& T_odom_robot, const FreeView& view,
                         double own_m);

  /// Whatever is unknown within `radius_m` counts as overlooked: somebody put the robot there.
  void overlook_round(const Instant& now, const Pose2& T_odom_robot, double radius_m);

  /// Something was felt at the robot's front, over 60 degrees to either side.
  void touch(const Instant& now, const Pose2& T_odom_robot, double radius_m, Reason why);

  /// What is at a point of the odom frame.
  Place at(const Instant& now, const Eigen::Vector2d& p_odom_m) const;

 private:
  struct Cell {
    std::int32_t column = 0;
    std::int32_t row = 0;
    Ground ground = Ground::kUnknown;
    Reason why = Reason::kUnknown;
    Duration seen{};
  };
  struct Ray;

  void open(const Instant& now, const Ray& ray);
  /// Rays pass above it: what is unknown there is overlooked.
  void overlook(const Instant& now, const Eigen::Vector2d& p_odom_m);
  void doubt(const Instant& now, const Ray& ray);
  /// Where along the doubtful part of a bearing something is closed; 0: nowhere.
  double closed_at_m(const Instant& now, const Ray& ray) const;
  void close_end(const Instant& now, const Ray& ray);
  void set(const Instant& now, const Eigen::Vector2d& p_odom_m, Ground ground, Reason why);
  bool is_well_in_view(std::size_t bin) const;
  /// Width of the bearings without readings that `bin` is one of.
  double dark_round_rad(const FreeView& view, std::size_t bin) const;
  Cell& cell_of(std::int32_t column, std::int32_t row);
  const Cell& cell_of(std::int32_t column, std::int32_t row) const;

  std::vector<Cell> cells_;
  // By bearing bin, with kEdgeBins more on either side: had it pixels with readings, ever?
  std::vector<bool> was_in_view_;
};

}  // namespace roomwise::safety
