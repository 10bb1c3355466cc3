#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/geometry/pose2.h"
#include "services/landmark_svc/core/landmark.h"

namespace roomwise::landmark {

/// When a landmark is known to stand still.
struct StandingParams {
  double age_min_s = 0.15;              ///< somebody who walks has moved by then
  double age_beside_mover_min_s = 0.6;  ///< ... but not who turns round: where something moves
  double mover_reach_m = 0.5;           ///< so near, or did lately
  double gap_beside_mover_max_s = 0.2;  ///< ... and all the while: who turns round comes back
  /// ... nor who walks along the line of sight, whom the moving mask cannot tell: so near to what
  /// is in doubt itself, where anything moved within wary_s.
  double age_beside_doubt_min_s = 0.4;
  double wary_s = 30.0;
  double slow_walk_mps = 0.45;  ///< who walks so slowly must have left the reach then, too
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
  /// Tells which of the landmarks remembered last are in doubt: those marked as moving by now.
  void remember_doubts(const std::vector<Landmark>& landmarks);

 private:
  struct Seen {
    LandmarkKind kind;
    Eigen::Vector2d p_odom_m;
    bool is_moving;    ///< by what its place was before
    bool is_in_doubt;  ///< not known to have stood
  };
  struct Past {
    std::int64_t utime = 0;
    std::vector<Seen> seen;
  };
  /// How long a landmark must have stood, and how long it may have been out of sight meanwhile.
  struct Wait {
    std::int64_t age_us;
    std::int64_t gap_us;
  };
  static constexpr std::size_t kFrames = 32;

  Wait wait_of(std::int64_t utime, const Eigen::Vector2d& p_odom_m, double reach_m,
               const StandingParams& params) const;
  template <class Test>
  bool any_seen_since(std::int64_t oldest_utime, Test test) const;

  std::array<Past, kFrames> past_;
  std::size_t known_ = 0;
  std::size_t next_ = 0;
  /// When anything moved last, in a second frame of those remembered: the mask errs in one alone,
  /// a walker does not show in one alone.
  std::optional<std::int64_t> moved_utime_;
};

}  // namespace roomwise::landmark
