#include "services/landmark_svc/core/moving_mask.h"

#include <gtest/gtest.h>

namespace roomwise::landmark {
namespace {

constexpr int kWidth_px = 160;
constexpr int kHeight_px = 120;
const PinholeCamera kCamera{146.0, 146.0, 79.5, 59.5};

/// A wall `wall_m` ahead; columns [begin, end) stand at `near_m` instead.
VirtualScan scan_of(double wall_m, double near_m, int begin, int end) {
  DepthImage depth{kWidth_px, kHeight_px, 0.001, {}};
  for (int v = 0; v < kHeight_px; ++v) {
    for (int u = 0; u < kWidth_px; ++u) {
      const double z_m = u >= begin && u < end ? near_m : wall_m;
      depth.steps.push_back(static_cast<std::uint16_t>(1000.0 * z_m));
    }
  }
  DisparityTable table;
  table.prepare(0.001, 351.0);
  Eigen::Isometry3d T_robot_camera = Eigen::Isometry3d::Identity();
  T_robot_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  T_robot_camera.translation().z() = 0.4;
  VirtualScan scan;
  scan.make(depth, kCamera, table, {Eigen::Vector3d::UnitY(), 0.4, 0}, T_robot_camera,
            {0, 0, kWidth_px, kHeight_px}, {});
  return scan;
}

TEST(VirtualScan, IsWhereTheThingsAre) {
  const VirtualScan scan = scan_of(2.5, 1.5, 60, 90);
  ASSERT_EQ(scan.points().size(), static_cast<std::size_t>(kWidth_px));
  for (const ScanPoint& point : scan.points()) {
    const bool is_near = point.u_px >= 60 && point.u_px < 90;
    EXPECT_NEAR(point.p_robot_m.x(), is_near ? 1.5 : 2.5, 0.01);
    EXPECT_NEAR(point.p_robot_m.y(), -point.along_m * (point.u_px - 79.5) / 146.0, 0.01);
  }
}

TEST(VirtualScan, TellsReadingsBeyondFromHoles) {
  const VirtualScan scan = scan_of(6.0, 3.3, 60, 90);
  EXPECT_EQ(scan.points().size(), 30U);
  ASSERT_EQ(scan.open_px().size(), static_cast<std::size_t>(kWidth_px - 30));
  for (const int u_px : scan.open_px()) EXPECT_TRUE(u_px < 60 || u_px >= 90) << u_px;
  EXPECT_TRUE(scan_of(0.0, 3.3, 60, 90).open_px().empty());
  EXPECT_TRUE(scan_of(65.535, 3.3, 60, 90).open_px().empty()) << "-1 is no reading";
}

TEST(MovingMask, FindsWhatCameAndLeavesWhatStands) {
  MovingMask mask;
  const MovingParams params;
  for (int i = 0; i < 6; ++i) {
    const int begin = 20 + 12 * i;
    const VirtualScan scan = scan_of(2.5, 1.5, begin, begin + 30);
    mask.update(100'000 * i, {}, scan, kCamera, kWidth_px, params);
  }
  ASSERT_FALSE(mask.points_m().empty());
  for (const auto& p_m : mask.points_m()) EXPECT_NEAR(p_m.x(), 1.5, 0.05);
  EXPECT_TRUE(mask.covers(mask.points_m().front(), params));
  EXPECT_FALSE(mask.covers({2.5, 0.9}, params));
}

// Three metres off in a hall nothing good lies behind who walks, but readings beyond 4095 mm do.
TEST(MovingMask, FindsWhatComesBeforeReadingsBeyond) {
  const auto moving_before = [](double wall_m) {
    MovingMask mask;
    for (int i = 0; i < 6; ++i) {
      const int begin = 20 + 12 * i;
      const VirtualScan scan = scan_of(wall_m, 3.3, begin, begin + 30);
      mask.update(100'000 * i, {}, scan, kCamera, kWidth_px, {});
    }
    return mask.points_m().size();
  };
  EXPECT_GT(moving_before(6.0), 0U);
  EXPECT_EQ(moving_before(0.0), 0U) << "holes that far off are unknown, not free";
}

TEST(MovingMask, KeepsQuietWhileTheRobotDrivesPastThingsAtRest) {
  MovingMask mask;
  for (int i = 0; i < 8; ++i) {
    const double driven_m = 0.05 * i;
    const double near_m = 1.5 - driven_m;
    const auto half_px = static_cast<int>(0.2 * 146.0 / near_m);
    const VirtualScan scan = scan_of(2.5 - driven_m, near_m, 80 - half_px, 80 + half_px);
    mask.update(100'000 * i, {driven_m, 0.0, 0.0}, scan, kCamera, kWidth_px, {});
    EXPECT_TRUE(mask.points_m().empty()) << i;
  }
}

TEST(MovingMask, TimeThatGoesBackStartsAnew) {
  MovingMask mask;
  for (const std::int64_t utime : {1'000'000, 1'200'000, 1'400'000}) {
    mask.update(utime, {}, scan_of(2.5, 2.5, 0, 0), kCamera, kWidth_px, {});
  }
  mask.update(500'000, {}, scan_of(2.5, 1.5, 40, 90), kCamera, kWidth_px, {});
  EXPECT_TRUE(mask.points_m().empty());
}

}  // namespace
}  // namespace roomwise::landmark
