// What is known of the camera and of the way.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "services/safety_svc/core/arc.h"
#include "tests/safety_svc/support/driven_world.h"

namespace roomwise::safety {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Instant kStart{seconds(100), time_from_utime(1'700'000'000'000'000)};

Instant later(Duration time) { return {kStart.steady + time, kStart.wall + time}; }

TEST(Arc, IsAQuarterOfACircleAfterAQuarterTurn) {
  const Pose2 pose = along_arc(M_PI / 2.0, 1.0);
  EXPECT_NEAR(pose.x_m, 1.0, 1e-12);
  EXPECT_NEAR(pose.y_m, 1.0, 1e-12);
  EXPECT_NEAR(pose.heading_rad, M_PI / 2.0, 1e-12);
  EXPECT_DOUBLE_EQ(along_arc(-0.5, 0.0).x_m, -0.5);
}

TEST(CameraMount, SaysWhereTheFloorComesIntoView) {
  const auto mount = mount_of(DrivenWorld::camera());
  ASSERT_TRUE(mount.has_value());
  EXPECT_NEAR(mount->floor_seen_from_m, 0.4 / (239.0 / 430.0), 1e-9);
  EXPECT_DOUBLE_EQ(mount->height_m, 0.4);
  EXPECT_NEAR(mount->up_in_camera.y(), -1.0, 1e-9);
  CameraSetup ahead = DrivenWorld::camera();
  ahead.p_robot_camera_m.x() = 0.1;
  EXPECT_NEAR(mount_of(ahead)->floor_seen_from_m, 0.1 + 0.4 / (239.0 / 430.0), 1e-9);
}

TEST(CameraMount, OfACameraThatLooksDownTheFloorComesIntoViewNearer) {
  CameraSetup down = DrivenWorld::camera();
  const Eigen::Quaterniond level(down.quat_wxyz[0], down.quat_wxyz[1], down.quat_wxyz[2],
                                 down.quat_wxyz[3]);
  const Eigen::Quaterniond q = level * Eigen::AngleAxisd(-0.3, Eigen::Vector3d::UnitX());
  down.quat_wxyz = {q.w(), q.x(), q.y(), q.z()};
  const double lowest_rad = 0.3 + std::atan(239.0 / 430.0);
  EXPECT_NEAR(mount_of(down)->floor_seen_from_m, 0.4 / std::tan(lowest_rad), 1e-9);
}

TEST(CameraMount, RefusesWhatSeesNoFloorAhead) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refuses = [](auto change) {
    CameraSetup setup = DrivenWorld::camera();
    change(setup);
    return !mount_of(setup).has_value();
  };
  EXPECT_TRUE(refuses([](auto& s) { s.quat_wxyz *= 1.1; }));
  EXPECT_TRUE(refuses([](auto& s) { s.quat_wxyz.setZero(); }));
  EXPECT_TRUE(refuses([](auto& s) { s.p_robot_camera_m.z() = 0.0; }));
  EXPECT_TRUE(refuses([](auto& s) { s.p_robot_camera_m.z() = -0.1; }));
  EXPECT_TRUE(refuses([](auto& s) { s.p_robot_camera_m.x() = 6.0; }));
  EXPECT_TRUE(refuses([](auto& s) { s.p_robot_camera_m.x() = std::sqrt(25.0 - 0.16); })) << "5 m";
  EXPECT_FALSE(refuses([](auto& s) { s.p_robot_camera_m.x() = std::sqrt(24.9 - 0.16); }));
  EXPECT_TRUE(refuses([&](auto& s) { s.p_robot_camera_m.x() = nan; }));
  EXPECT_TRUE(refuses([&](auto& s) { s.fy_px = nan; }));
  EXPECT_TRUE(refuses([](auto& s) { s.fy_px = 4300.0; })) << "farther than 5 m";
  EXPECT_TRUE(refuses([](auto& s) { s.cy_px = 500.0; })) << "looks up";
  EXPECT_TRUE(refuses([](auto& s) {
    const Eigen::Quaterniond upright(s.quat_wxyz[0], s.quat_wxyz[1], s.quat_wxyz[2],
                                     s.quat_wxyz[3]);
    const Eigen::Quaterniond lying =
        upright * Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitZ());
    s.quat_wxyz = {lying.w(), lying.x(), lying.y(), lying.z()};
  })) << "lies on its side";
  EXPECT_TRUE(refuses([](auto& s) { s.quat_wxyz = {0.5, -0.5, -0.5, 0.5}; })) << "looks back";
  EXPECT_TRUE(refuses([](auto& s) { s.quat_wxyz = {1.0, 0.0, 0.0, 0.0}; })) << "lies on its side";
}

TEST(CameraMount, NoticesTiltAndHeight) {
  const CameraMount mount = *mount_of(DrivenWorld::camera());
  const auto leaning = [](double angle_rad) {
    return Eigen::Vector3d(0.0, -std::cos(angle_rad), std::sin(angle_rad));
  };
  EXPECT_FALSE(is_tilted(mount, leaning(0.0), 0.4));
  EXPECT_FALSE(is_tilted(mount, leaning(kTilt_rad - 1e-3), 0.4));
  EXPECT_TRUE(is_tilted(mount, leaning(kTilt_rad + 1e-3), 0.4));
  EXPECT_FALSE(is_tilted(mount, leaning(0.0), 0.4 + kHeight_m - 1e-3));
  EXPECT_TRUE(is_tilted(mount, leaning(0.0), 0.4 + kHeight_m + 1e-3));
  EXPECT_TRUE(is_tilted(mount, leaning(0.0), 0.4 - kHeight_m - 1e-3));
  EXPECT_TRUE(is_tilted(mount, leaning(0.0) * 1.1, 0.4));
  EXPECT_TRUE(is_tilted(mount, leaning(0.0), std::numeric_limits<double>::quiet_NaN()));
}

OdometrySample sample_at(Duration time, double x_m, double step_m) {
  return {.time = kStart.wall + time,
          .interval = milliseconds(100),
          .distance_m = step_m,
          .T_odom_robot = {x_m, 0.0, 0.0}};
}

TEST(OdometryTrack, KnowsWhereItWasAndWhereItIs) {
  OdometryTrack track;
  EXPECT_FALSE(track.pose_at(kStart.wall).has_value());
  EXPECT_EQ(track.pose_now(kStart).x_m, 0.0);
  ASSERT_EQ(track.add(kStart, sample_at(milliseconds(0), 0.0, 0.0)), OdometryResult::kStartedAnew);
  ASSERT_EQ(track.add(later(milliseconds(100)), sample_at(milliseconds(100), 0.02, 0.02)),
            OdometryResult::kUsed);
  EXPECT_DOUBLE_EQ(track.pose_at(kStart.wall)->x_m, 0.0);
  EXPECT_DOUBLE_EQ(track.pose_at(kStart.wall + milliseconds(50))->x_m, 0.01);
  EXPECT_DOUBLE_EQ(track.pose_at(kStart.wall + milliseconds(300))->x_m, 0.06);
  EXPECT_FALSE(track.pose_at(kStart.wall + milliseconds(301)).has_value());
  EXPECT_FALSE(track.pose_at(kStart.wall - Duration(1)).has_value());
  EXPECT_DOUBLE_EQ(track.pose_now(later(milliseconds(200))).x_m, 0.04);
  EXPECT_DOUBLE_EQ(track.pose_now(later(seconds(9))).x_m, 0.02 + 0.2 * 0.35);
  EXPECT_DOUBLE_EQ(track.speed_mps(), 0.2);
}

TEST(OdometryTrack, BetweenSamplesItTurnsTheShortWay) {
  OdometryTrack track;
  OdometrySample before = sample_at(milliseconds(0), 0.0, 0.0);
  OdometrySample after = sample_at(milliseconds(100), 0.0, 0.0);
  before.T_odom_robot.heading_rad = M_PI - 0.1;
  after.T_odom_robot.heading_rad = 0.2 - M_PI;
  ASSERT_EQ(track.add(kStart, before), OdometryResult::kStartedAnew);
  ASSERT_EQ(track.add(later(milliseconds(100)), after), OdometryResult::kUsed);
  EXPECT_NEAR(track.pose_at(kStart.wall + milliseconds(20))->heading_rad, M_PI - 0.04, 1e-12);
  EXPECT_NEAR(track.pose_at(kStart.wall + milliseconds(50))->heading_rad, 0.05 - M_PI, 1e-12);
}

TEST(OdometryTrack, PastTheNewestItGoesOnAlongTheChord) {
  OdometryTrack track;
  OdometrySample sample = sample_at(milliseconds(0), 0.0, 0.05);
  sample.turn_rad = 0.1;
  ASSERT_EQ(track.add(kStart, sample), OdometryResult::kStartedAnew);
  const Pose2 pose = *track.pose_at(kStart.wall + milliseconds(100));
  EXPECT_NEAR(pose.x_m, 0.05 * std::cos(0.05), 1e-12);
  EXPECT_NEAR(pose.y_m, 0.05 * std::sin(0.05), 1e-12);
  EXPECT_NEAR(pose.heading_rad, 0.1, 1e-12);
}

TEST(OdometryTrack, RefusesWhatNoCreateDoes) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto result = [](auto change) {
    OdometryTrack track;
    OdometrySample sample = sample_at(milliseconds(0), 0.0, 0.0);
    change(sample);
    return track.add(kStart, sample);
  };
  const auto refused = OdometryResult::kRefused;
  const auto used = OdometryResult::kStartedAnew;
  EXPECT_EQ(result([](auto& s) { s.interval = Duration(0); }), refused);
  EXPECT_EQ(result([](auto& s) { s.interval = Duration(1); }), used);
  EXPECT_EQ(result([](auto& s) { s.interval = seconds(5); }), used);
  EXPECT_EQ(result([](auto& s) { s.interval = seconds(5) + Duration(1); }), refused);
  EXPECT_EQ(result([](auto& s) { s.distance_m = 0.2; }), used);
  EXPECT_EQ(result([](auto& s) { s.distance_m = -0.201; }), refused);
  EXPECT_EQ(result([](auto& s) { s.turn_rad = 2.0; }), used);
  EXPECT_EQ(result([](auto& s) { s.turn_rad = 2.01; }), refused);
  EXPECT_EQ(result([](auto& s) { s.T_odom_robot.x_m = 1e5; }), refused);
  EXPECT_EQ(result([](auto& s) { s.T_odom_robot.y_m = -1e5; }), refused);
  EXPECT_EQ(result([](auto& s) { s.T_odom_robot.heading_rad = 4.0; }), refused);
  EXPECT_EQ(result([&](auto& s) { s.T_odom_robot.heading_rad = nan; }), refused);
  EXPECT_EQ(result([&](auto& s) { s.distance_m = nan; }), refused);
}

TEST(OdometryTrack, StandsUpToItsLimits) {
  for (const auto& [distance_m, turn_rad, stands] :
       {std::tuple(kStanding_mps, kStanding_radps, true),
        {-0.0601, 0.0, false},
        {0.0, -0.301, false}}) {
    OdometryTrack track;
    OdometrySample sample = sample_at(milliseconds(0), 0.0, distance_m);
    sample.interval = seconds(1);
    sample.turn_rad = turn_rad;
    ASSERT_EQ(track.add(kStart, sample), OdometryResult::kStartedAnew);
    EXPECT_EQ(track.stands(), stands);
  }
}

/// Drives ahead by 2.5 cm ten times.
OdometryTrack driven_track() {
  OdometryTrack track;
  for (int i = 0; i <= 10; ++i) {
    (void)track.add(later(milliseconds(100 * i)),
                    sample_at(milliseconds(100 * i), 0.025 * i, 0.025));
  }
  return track;
}

TEST(OdometryTrack, TheWayBackIsAsLongAsTheWayCameAndFades) {
  const OdometryTrack track = driven_track();
  const Instant now = later(milliseconds(1000));
  EXPECT_NEAR(track.reverse_way_m(now, 0.0), 0.27, 0.02);
  EXPECT_LT(track.reverse_way_m(now, 8.0), 0.15) << "another way";
  EXPECT_EQ(track.reverse_way_m(later(seconds(22)), 0.0), 0.0);
}

TEST(OdometryTrack, WhereItStoodAtFirstItMayComeBackTo) {
  OdometryTrack track;
  for (int i = 0; i <= 5; ++i) {
    (void)track.add(later(milliseconds(100 * i)),
                    sample_at(milliseconds(100 * i), 0.02 * i, i == 0 ? 0.0 : 0.02));
  }
  EXPECT_DOUBLE_EQ(track.reverse_way_m(later(milliseconds(500)), 0.0), 0.12);
}

TEST(OdometryTrack, TheWayBackIsHalfAMetreAtMost) {
  OdometryTrack track;
  for (int i = 0; i <= 50; ++i) {
    (void)track.add(later(milliseconds(100 * i)), sample_at(milliseconds(100 * i), 0.02 * i, 0.02));
  }
  EXPECT_DOUBLE_EQ(track.reverse_way_m(later(milliseconds(5000)), 0.0), kReverse_m);
}

TEST(OdometryTrack, TheWayBackIsKnownForItsLifeAndNoLonger) {
  OdometryTrack track;
  (void)track.add(kStart, sample_at(milliseconds(0), 0.0, 0.0));
  EXPECT_DOUBLE_EQ(track.reverse_way_m(later(kTrackLife), 0.0), 0.02);
  EXPECT_EQ(track.reverse_way_m(later(kTrackLife + Duration(1)), 0.0), 0.0);
}

TEST(OdometryTrack, JustAfterTheMachineStartedItKnowsOnlyWhereItWas) {
  const Instant boot{milliseconds(100), kStart.wall};
  OdometryTrack track;
  EXPECT_EQ(track.reverse_way_m(boot, 0.0), 0.0);
  (void)track.add(boot, sample_at(milliseconds(0), 0.05, 0.0));
  EXPECT_DOUBLE_EQ(track.reverse_way_m(boot, 0.0), 0.02);
}

TEST(OdometryTrack, ANewFrameForgetsTheWayBack) {
  OdometryTrack track = driven_track();
  OdometrySample sample = sample_at(milliseconds(1100), 9.0, 0.0);
  sample.reset_counter = 1;
  EXPECT_EQ(track.add(later(milliseconds(1100)), sample), OdometryResult::kStartedAnew);
  EXPECT_LE(track.reverse_way_m(later(milliseconds(1100)), 0.0), 0.03);
  EXPECT_FALSE(track.pose_at(kStart.wall + milliseconds(1000)).has_value());
}

}  // namespace
}  // namespace roomwise::safety
