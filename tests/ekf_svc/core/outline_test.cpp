#include "services/ekf_svc/core/outline.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

#include "services/ekf_svc/core/slam.h"

namespace roomwise::ekf {
namespace {

constexpr std::int8_t kEdgeRight = 2;
constexpr std::int8_t kCrease = 3;

RC_GTEST_PROP(Outline, WhatRepeatsAfterAWayRepeatsAfterALongerOne, ()) {
  const double off_m = 0.1 + 1e-3 * *rc::gen::inRange(-200, 200);
  const double way_m = 1e-3 * *rc::gen::inRange(0, 3000);
  const double longer_m = way_m + 1e-3 * *rc::gen::inRange(0, 3000);
  const RangeOff before{.off_m = 0.1, .travel_m = 7.0};
  const bool repeats_then = repeats(before, {.off_m = off_m, .travel_m = 7.0 + way_m});
  RC_ASSERT(!repeats_then || repeats(before, {.off_m = off_m, .travel_m = 7.0 + longer_m}));
}

TEST(Outline, RepeatIsAskedOfWhatWasSeenLately) {
  const RangeOff before{.off_m = 0.1, .travel_m = 7.0};
  EXPECT_TRUE(repeats(before, {.off_m = 0.18, .travel_m = 7.0}));
  EXPECT_FALSE(repeats(before, {.off_m = 0.20, .travel_m = 7.0}));
  EXPECT_FALSE(repeats(before, {.off_m = 0.45, .travel_m = 8.0}));
  EXPECT_TRUE(repeats(before, {.off_m = 5.0, .travel_m = 9.1}));
  EXPECT_TRUE(repeats(RangeOff{}, {.off_m = 5.0, .travel_m = 0.0}));
}

TEST(Outline, RangeOffIsMeasuredAlongTheLineOfSight) {
  Residual chord;
  BodyObservation seen{.p_robot_m = {3.0, 0.0}};
  chord.innovation = Eigen::Vector2d(0.2, 0.0);
  EXPECT_NEAR(range_off(chord, seen, 1.0).off_m, 0.2, 1e-12);
  chord.innovation = Eigen::Vector2d(3.0, -3.0);  // predicted at as many metres, to the left
  EXPECT_NEAR(range_off(chord, seen, 1.0).off_m, 0.0, 1e-12);
}

TEST(Outline, IsSofterTheFartherRoundItIsSeenFrom) {
  const Eigen::Matrix2d none = Eigen::Matrix2d::Zero();
  EXPECT_EQ(turned_softening(0.0, 0.08), none);
  EXPECT_EQ(turned_softening(std::nan(""), 0.08), none);
  EXPECT_EQ(turned_softening(1.0, 0.0), none);
  EXPECT_NEAR(turned_softening(0.5, 0.08)(0, 0), 0.04 * 0.04, 1e-12);
  EXPECT_NEAR(turned_softening(-0.5, 0.08)(1, 1), 0.04 * 0.04, 1e-12);
  const double once_round_rad = 2.0 * 3.14159265358979;
  EXPECT_LT(turned_softening(once_round_rad, 0.08)(0, 0), 1e-20);
}

/// A pillar's two corners in one line of sight, as a camera sees now the one, now the other.
class CornersInLine : public testing::Test {
 protected:
  void look(double range_m, std::int8_t kind) {
    constexpr double kAlongSigma_m = 0.15;
    Sighting sighting;
    sighting.polar.range_m = range_m - slam_.travel_m();
    sighting.polar.covariance = Eigen::Vector2d(kAlongSigma_m * kAlongSigma_m, 1e-6).asDiagonal();
    sighting.kind = kind;
    std::vector<Verdict> verdicts{Verdict::kMatched};
    slam_.process(std::vector{sighting}, true, verdicts);
  }
  void advance() {
    MotionIncrement motion;
    motion.append(arc_step(0.02, 0.0, 1e-8 * Eigen::Matrix2d::Identity()));
    slam_.predict(motion);
  }
  /// Landmarks of the map after frames that show the corners in turns.
  std::size_t corners_mapped(std::int8_t kind) {
    for (int frame = 0; frame < 40; ++frame) {
      look(frame / 4 % 2 == 0 ? 3.0 : 3.4, kind);
      advance();
    }
    return slam_.filter().mapped_count();
  }

  Slam slam_{EkfParams{}};
};

TEST_F(CornersInLine, OfOutlinesAreTwoThoughTheGateTakesThemForOne) {
  EXPECT_EQ(corners_mapped(kEdgeRight), 2U);
}

TEST_F(CornersInLine, OfOtherKindsHaveTheGateAlone) { EXPECT_EQ(corners_mapped(kCrease), 1U); }

/// A door leaf 4 cm thick: its one corner is the outline from the south, its other from the west.
class DoorLeaf : public testing::Test {
 protected:
  /// Error of the heading after the robot has gone a quarter round it, odometry's scale unknown.
  static double heading_error_rad(double shift_m_per_rad) {
    EkfParams params;
    params.outline_shift_m_per_rad = shift_m_per_rad;
    Slam slam{params};
    Pose2 truth;
    for (int step = 0; step < 120; ++step) {
      MotionIncrement motion;
      motion.append(arc_step(0.02, step < 60 ? 0.0 : 0.02, 1e-6 * Eigen::Matrix2d::Identity()));
      truth = moved(truth, motion);
      slam.predict(motion);
      const bool from_far = step < 60;
      const Eigen::Vector2d corner_m(from_far ? 2.0 : 2.04, from_far ? 0.98 : 1.0);
      std::vector<Sighting> sightings{sighting(truth, corner_m, kEdgeRight)};
      for (const Eigen::Vector2d& p_m : {Eigen::Vector2d(3.0, 3.0), Eigen::Vector2d(0.5, 3.0)}) {
        sightings.push_back(sighting(truth, p_m, kCrease));
      }
      std::vector<Verdict> verdicts(sightings.size(), Verdict::kMatched);
      slam.process(sightings, true, verdicts);
    }
    return std::abs(wrap_angle(slam.filter().pose().heading_rad - truth.heading_rad));
  }
  static Sighting sighting(const Pose2& robot, const Eigen::Vector2d& p_map_m, std::int8_t kind) {
    const Eigen::Vector2d p_m = transform(inverse(robot), p_map_m);
    Sighting sighting;
    sighting.polar.range_m = p_m.norm();
    sighting.polar.bearing_rad = std::atan2(p_m.y(), p_m.x());
    sighting.polar.covariance = Eigen::Vector2d(4e-4, 1e-4).asDiagonal();
    sighting.kind = kind;
    return sighting;
  }
};

TEST_F(DoorLeaf, SeenFromItsOtherSideTurnsTheRobotLess) {
  const double sharp_rad = heading_error_rad(0.0);
  EXPECT_GT(sharp_rad, 1e-4);
  EXPECT_LT(heading_error_rad(0.08), 0.7 * sharp_rad);
}

}  // namespace
}  // namespace roomwise::ekf
