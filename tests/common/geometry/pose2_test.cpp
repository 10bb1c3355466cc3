#include "common/geometry/pose2.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numbers>

namespace roomwise {
namespace {

double any_angle() { return static_cast<double>(*rc::gen::inRange(-1'000'000, 1'000'000)) * 1e-4; }
Pose2 any_pose() { return {any_angle(), any_angle(), wrap_angle(any_angle())}; }

void assert_near(const Pose2& a, const Pose2& b) {
  RC_ASSERT(std::abs(a.x_m - b.x_m) < 1e-9);
  RC_ASSERT(std::abs(a.y_m - b.y_m) < 1e-9);
  RC_ASSERT(std::abs(wrap_angle(a.heading_rad - b.heading_rad)) < 1e-9);
}

RC_GTEST_PROP(WrapAngle, StaysInRangeAndKeepsTheDirection, ()) {
  const double angle_rad = any_angle();
  const double wrapped_rad = wrap_angle(angle_rad);
  RC_ASSERT(wrapped_rad >= -std::numbers::pi && wrapped_rad < std::numbers::pi);
  RC_ASSERT(std::abs(std::sin(wrapped_rad) - std::sin(angle_rad)) < 1e-9);
  RC_ASSERT(std::abs(std::cos(wrapped_rad) - std::cos(angle_rad)) < 1e-9);
}

TEST(WrapAngle, PutsBothEndsAtMinusPi) {
  EXPECT_EQ(wrap_angle(std::numbers::pi), -std::numbers::pi);
  EXPECT_EQ(wrap_angle(-std::numbers::pi), -std::numbers::pi);
  EXPECT_GE(wrap_angle(std::nextafter(-std::numbers::pi, -4.0)), -std::numbers::pi);
  EXPECT_LT(wrap_angle(std::nextafter(-std::numbers::pi, -4.0)), std::numbers::pi);
}

RC_GTEST_PROP(Pose2, ComposingWithTheInverseIsTheIdentity, ()) {
  const Pose2 T_a_b = any_pose();
  assert_near(compose(T_a_b, inverse(T_a_b)), {});
  assert_near(compose(inverse(T_a_b), T_a_b), {});
}

RC_GTEST_PROP(Pose2, CompositionIsAssociativeAndAgreesWithTransform, ()) {
  const Pose2 a = any_pose();
  const Pose2 b = any_pose();
  const Pose2 c = any_pose();
  assert_near(compose(compose(a, b), c), compose(a, compose(b, c)));
  const Eigen::Vector2d p_m(any_angle(), any_angle());
  RC_ASSERT((transform(compose(a, b), p_m) - transform(a, transform(b, p_m))).norm() < 1e-9);
}

}  // namespace
}  // namespace roomwise
