#include "logs/tools/alignment.h"

#include <gtest/gtest.h>

#include "tests/rwlog/poses.h"

namespace roomwise {
namespace {

Points2 moved_points(const Pose2& T_b_a, const Points2& p_a_m) {
  Points2 p_b_m;
  for (const auto& p_m : p_a_m) p_b_m.push_back(transform(T_b_a, p_m));
  return p_b_m;
}

Points2 some_points(std::size_t fewest) {
  Points2 points;
  for (const TimedPose2& timed : *any_trajectory(fewest)) {
    points.push_back(timed.pose.position_m());
  }
  return points;
}

RC_GTEST_PROP(Alignment, RecoversAnyRigidMotion, ()) {
  const Points2 p_a_m = some_points(2);
  RC_PRE((p_a_m.front() - p_a_m.back()).norm() > 0.1);
  const Pose2 T_b_a = *any_pose();
  const Points2 p_b_m = moved_points(T_b_a, p_a_m);
  const Pose2 found = align_rigidly(p_a_m, p_b_m);
  RC_ASSERT(rms_distance_m(found, p_a_m, p_b_m) < 1e-9);
  RC_ASSERT(std::abs(wrap_angle(found.heading_rad - T_b_a.heading_rad)) < 1e-9);
}

RC_GTEST_PROP(Alignment, NoOtherMotionIsBetter, (int seed)) {
  const Points2 p_a_m = some_points(3);
  Points2 p_b_m = moved_points(*any_pose(), p_a_m);
  for (std::size_t i = 0; i < p_b_m.size(); ++i) {
    p_b_m[i].x() += 0.3 * std::sin(static_cast<double>(i) + seed % 100);
  }
  const Pose2 best = align_rigidly(p_a_m, p_b_m);
  const Pose2 nudge{*number_between(-0.1, 0.1), *number_between(-0.1, 0.1),
                    *number_between(-0.1, 0.1)};
  RC_ASSERT(rms_distance_m(best, p_a_m, p_b_m) <=
            rms_distance_m(compose(best, nudge), p_a_m, p_b_m) + 1e-12);
}

TEST(Alignment, OfOnePointOnlyMovesIt) {
  const Pose2 found = align_rigidly({{1.0, 2.0}}, {{4.0, -1.0}});
  EXPECT_DOUBLE_EQ(found.x_m, 3.0);
  EXPECT_DOUBLE_EQ(found.y_m, -3.0);
  EXPECT_DOUBLE_EQ(found.heading_rad, 0.0);
}

TEST(Alignment, RefusesPointsWithoutPartners) {
  EXPECT_THROW(align_rigidly({}, {}), std::logic_error);
  EXPECT_THROW(align_rigidly({{1.0, 2.0}}, {}), std::logic_error);
}

}  // namespace
}  // namespace roomwise
