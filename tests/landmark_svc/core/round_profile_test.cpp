#include "services/landmark_svc/core/round_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace roomwise::landmark {
namespace {

/// Points on a cylinder's near side from its left outline inwards, seen from the origin.
std::vector<Eigen::Vector2d> arc_from_left(const Eigen::Vector2d& center_m, double radius_m) {
  std::vector<Eigen::Vector2d> points;
  const double toward_rad = std::atan2(-center_m.y(), -center_m.x());
  const double outline_rad = std::acos(radius_m / center_m.norm());
  for (int i = 0; i < 12; ++i) {
    const double angle_rad = toward_rad - outline_rad + 0.08 * (i + 1);
    points.push_back(center_m +
                     radius_m * Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad)));
  }
  return points;
}

Eigen::Vector2d left_outline_ray(const Eigen::Vector2d& center_m, double radius_m) {
  const double bearing_rad =
      std::atan2(center_m.y(), center_m.x()) + std::asin(radius_m / center_m.norm());
  return {std::cos(bearing_rad), std::sin(bearing_rad)};
}

TEST(TangentCircle, FindsCentreAndRadiusFromAnArcBesideTheOutline) {
  for (const double radius_m : {0.05, 0.17, 0.5}) {
    const Eigen::Vector2d center_m(2.0, 0.4);
    const auto circle = fit_tangent_circle(arc_from_left(center_m, radius_m),
                                           left_outline_ray(center_m, radius_m), false);
    ASSERT_TRUE(circle) << radius_m;
    EXPECT_NEAR(circle->radius_m, radius_m, 1e-3);
    EXPECT_LT((circle->center_m - center_m).norm(), 2e-3);
  }
}

TEST(TangentCircle, NeedsFivePointsAndARay) {
  const std::vector<Eigen::Vector2d> few(4, Eigen::Vector2d(2.0, 0.0));
  EXPECT_FALSE(fit_tangent_circle(few, {1.0, 0.0}, true));
  const std::vector<Eigen::Vector2d> enough(9, Eigen::Vector2d(2.0, 0.0));
  EXPECT_FALSE(fit_tangent_circle(enough, {0.0, 0.0}, true));
}

TEST(LineRms, IsZeroOnALineAndGrowsWithABend) {
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < 10; ++i) points.emplace_back(1.0 + 0.1 * i, 0.3 * i);
  EXPECT_NEAR(line_rms_m(points), 0.0, 1e-9);
  points[5].x() += 0.1;
  EXPECT_GT(line_rms_m(points), 0.01);
}

}  // namespace
}  // namespace roomwise::landmark
