#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "common/geometry/pose2.h"
#include "common/image/rgbd_frame.h"
#include "services/landmark_svc/core/virtual_scan.h"

namespace roomwise::landmark {

/// What is taken for moving.
struct MovingParams {
  double memory_s = 1.0;       ///< how long ago a place may have been seen free
  double margin_m = 0.15;      ///< by how much farther it was seen then, plus the next line
  double margin_ratio = 0.03;  ///< of the distance
  double unseen_free_m = 3.0;  ///< nothing measured then: anything nearer would have been seen
  double width_min_m = 0.10;   ///< of what has come there
  double reach_m = 0.30;       ///< how far around it things move with it: arms beyond legs
};

/// Finds what moves by looking back: a point of this scan whose place at least two earlier scans
/// saw through is where nothing was. Earlier scans are laid over this one by the odometry. Points
/// next to each other make a moving thing if they are wide enough. Nothing is said of what was
/// hidden or out of view then.
///
/// Keeps kScans scans, 0.1 s apart or more; fixed memory after the first.
class MovingMask {
 public:
  /// Makes room for scans of that width: update() allocates nothing then.
  void reserve(int width_px);
  /// Looks at a frame's scan. `width_px` columns; times that go back start anew.
  void update(std::int64_t utime, const Pose2& T_odom_robot, const VirtualScan& scan,
              const PinholeCamera& camera, int width_px, const MovingParams& params);
  /// Forgets all: the odometry started anew or is missing.
  void clear();

  /// Whether a place of the newest frame belongs to something that moves.
  bool covers(const Eigen::Vector2d& p_robot_m, const MovingParams& params) const;
  /// Points of the newest scan that do. Robot frame.
  const std::vector<Eigen::Vector2d>& points_m() const { return moving_m_; }

 private:
  static constexpr std::size_t kScans = 10;
  struct Past {
    std::int64_t utime = 0;
    Eigen::Vector2d origin_m{0.0, 0.0};  ///< camera, odom frame
    Eigen::Vector2d forward{1.0, 0.0};   ///< of the camera, odom frame
    std::vector<float> along_m;          ///< by column; 0: nothing measured
  };

  bool was_free(const Past& past, const Eigen::Vector2d& p_odom_m, const PinholeCamera& camera,
                const MovingParams& params) const;
  void remember(std::int64_t utime, const Pose2& T_odom_robot, const VirtualScan& scan,
                int width_px);

  std::array<Past, kScans> past_;
  std::size_t known_ = 0;  ///< how many of past_ hold something
  std::size_t next_ = 0;
  std::int64_t newest_utime_ = 0;
  std::vector<std::uint8_t> came_;  ///< of each point of the scan
  std::vector<Eigen::Vector2d> moving_m_;
};

}  // namespace roomwise::landmark
