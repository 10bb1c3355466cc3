#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "common/geometry/pose2.h"
#include "common/time.h"
#include "services/pilot_svc/core/pilot_params.h"

namespace roomwise::pilot {

/// How far the way is free along some bearings, seen from the robot frame's origin.
struct FreeView {
  double first_bearing_rad = 0.0;
  double bearing_step_rad = 0.0;
  std::span<const double> free_range_m;
  std::span<const double> unknown_ratio;     ///< as many; 1: not in view
  std::span<const double> obstacle_range_m;  ///< as many; to what is seen to stand there; 0: none
};

/// What stands round the robot, in cells of 5 cm of the odom frame, kept while the camera, which
/// looks forward only, sees something else.
///
/// Along a bearing with free range f: floor_seen_from .. f is free, and what ends it stands at f.
/// Floor is seen to end a little before what stands on it: if that is seen, it stands where it is
/// seen. With f = 0 the floor did not come into view; if nothing near is seen to hide it and
/// nothing is remembered there already, something is guessed to stand between what a Kinect can
/// measure and where floor is first seen.
///
/// Each reading is the median of a bin and its neighbours, and a cell counts as blocked from the
/// second frame on that sees something end there, less those that see floor only: a single bin that
/// ends short in a single frame turns nobody aside. At the view's edges, where a bearing is in view
/// only near by or only far off, ends say nothing.
///
/// Cells are a torus of 6.4 m: what is farther apart shares one, and the newer place wins.
class ObstacleMemory {
 public:
  static constexpr double kCell_m = 0.05;

  explicit ObstacleMemory(const PilotParams& params);

  /// A new odom frame.
  void forget();

  /// Takes up what was seen from `T_odom_robot`. False, and nothing changed, if its numbers are no
  /// view: counts that differ, none or more than 1000, or anything not finite.
  [[nodiscard]] bool see(Time now, const Pose2& T_odom_robot, const FreeView& view);

  /// Something is said to stand there, though nobody saw it.
  void refuse(Time now, const Eigen::Vector2d& p_odom_m);

  /// Replaces `points_robot_m` by what is remembered within reach, in a fixed order. Allocates
  /// nothing once the vector has room for capacity() points.
  void obstacles_round(Time now, const Pose2& T_odom_robot,
                       std::vector<Eigen::Vector2d>& points_robot_m) const;
  static constexpr std::size_t capacity() { return kSide * kSide; }

  /// True if the point was seen as floor, or something was seen to stand there.
  bool is_known(Time now, const Eigen::Vector2d& p_odom_m) const;

 private:
  static constexpr int kSide = 128;
  struct Cell {
    std::int32_t column = INT32_MIN;
    std::int32_t row = INT32_MIN;
    int sightings = 0;
    Time fades{};
    Time seen{};
    bool seen_blocked = false;  ///< in the frame of that time
  };
  struct Place {
    std::int32_t column;
    std::int32_t row;
  };

  static Place place_of(const Eigen::Vector2d& p_odom_m);
  static std::size_t slot_of(const Place& place);
  const Cell* find(Time now, const Place& place) const;
  bool is_blocked(Time now, const Eigen::Vector2d& p_odom_m) const;
  void set(Time now, const Eigen::Vector2d& p_odom_m, bool is_blocked, double for_s);
  void see_floor(Time now, const Pose2& T_odom_robot, double bearing_rad, double free_m);
  void see_end(Time now, const Pose2& T_odom_robot, double bearing_rad, double free_m,
               double obstacle_m);
  void guess(Time now, const Pose2& T_odom_robot, double bearing_rad);

  PilotParams params_;
  std::vector<Cell> cells_;
};

}  // namespace roomwise::pilot
