#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "common/geometry/pose2.h"
#include "services/landmark_svc/core/landmark.h"

namespace roomwise::landmark {

/// When a landmark is known to stand still.
struct StandingParams {
  double age_min_s = 0.15;              ///< somebody who walks has moved by then
  double age_beside_mover_min_s = 0.6;  ///< ... but not who turns round: where something moves
  double mover_reach_m = 0.5;           ///< so near, or did lately
  double age_max_s = 1.0;
  double reach_m = 0.05;      ///< from where it was seen then, plus the next line
  double reach_ratio = 0.01;  ///< of its range
};

/// Remembers the landmarks of the last second in the odometry's frame: what has been seen, as the
/// same kind, at the same place for a while does not walk. Fixed memory after the first frames.
class Standing {
 public:
  /// Makes room for so many landmarks a frame: remember() allocates nothing then.
  void reserve(std::size_t landmarks);
  /// Forgets all.
  void clear();
  /// Whether a landmark of a frame at `utime` has stood there before. True while nothing old
  /// enough is remembered at all: nobody can tell then.
  bool has_stood(std::int64_t utime, const Pose2& T_odom_robot, const Landmark& landmark,
                 const StandingParams& params) const;
  /// Takes a frame's landmarks, with what of them moves. Times that go back start anew.
  void remember(std::int64_t utime, const Pose2& T_odom_robot,
                const std::vector<Landmark>& landmarks);

 private:
  struct Seen {
    LandmarkKind kind;
    Eigen::Vector2d p_odom_m;
    bool is_moving;
  };
  struct Past {
    std::int64_t utime = 0;
    std::vector<Seen> seen;
  };
  static constexpr std::size_t kFrames = 32;

  bool is_beside_mover(const Eigen::Vector2d& p_odom_m, std::int64_t oldest_utime,
                       double reach_m) const;

  std::array<Past, kFrames> past_;
  std::size_t known_ = 0;
  std::size_t next_ = 0;
};

}  // namespace roomwise::landmark
