#include "services/pilot_svc/core/free_way.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

namespace roomwise::pilot {
namespace {

std::vector<Eigen::Vector2d> some_points() {
  const auto place = rc::gen::inRange(-3000, 3000);
  std::vector<Eigen::Vector2d> points;
  const int count = *rc::gen::inRange(0, 30);
  for (int i = 0; i < count; ++i) points.emplace_back(*place * 1e-3, *place * 1e-3);
  return points;
}

RC_GTEST_PROP(SweptWay, NothingIsTouchedBeforeItsEnd, ()) {
  const auto points = some_points();
  const double bearing_rad = *rc::gen::inRange(-3141, 3141) * 1e-3;
  const double way_m = swept_way_m(points, bearing_rad, 0.25, 3.0);
  for (const auto& p_m : points) {
    if (p_m.norm() < 0.25) continue;  // touched already
    for (double r = 0.0; r < way_m; r += 0.01) {
      const Eigen::Vector2d at_m(r * std::cos(bearing_rad), r * std::sin(bearing_rad));
      RC_ASSERT((p_m - at_m).norm() > 0.25 - 1e-9);
    }
  }
}

RC_GTEST_PROP(SweptWay, AnotherPointOrAWiderRobotNeverLengthensIt, ()) {
  auto points = some_points();
  const double bearing_rad = *rc::gen::inRange(-3141, 3141) * 1e-3;
  const double way_m = swept_way_m(points, bearing_rad, 0.25, 3.0);
  RC_ASSERT(swept_way_m(points, bearing_rad, 0.3, 3.0) <= way_m);
  points.emplace_back(1.0, 0.1);
  RC_ASSERT(swept_way_m(points, bearing_rad, 0.25, 3.0) <= way_m);
}

TEST(SweptWay, EndsARadiusBeforeAPointStraightAhead) {
  const std::vector<Eigen::Vector2d> points{{1.0, 0.0}};
  EXPECT_DOUBLE_EQ(swept_way_m(points, 0.0, 0.25, 3.0), 0.75);
  EXPECT_DOUBLE_EQ(swept_way_m(points, 1.0, 0.25, 3.0), 3.0);
}

TEST(FreeWay, UnknownIsNotFreeBeyondTheBlindZone) {
  const PilotParams params;
  const ObstacleMemory memory(params);
  const VisitMemory visits;
  const Surroundings around{time_from_utime(1), {}, {}, memory, visits};
  EXPECT_DOUBLE_EQ(free_way_m(around, 0.0, 0.25, params), params.blind_m);
}

}  // namespace
}  // namespace roomwise::pilot
