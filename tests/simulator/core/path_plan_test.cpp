#include "services/simulator/core/path_plan.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "common/geometry/angle.h"

namespace roomwise::simulator {
namespace {

constexpr double kSample_s = 0.01;

/// A start and a path of 1 to 6 corners at least 0.2 m apart.
struct Case {
  Pose2 start;
  Path path;
};

Case any_case() {
  const auto coordinate = [] { return *rc::gen::inRange(-40, 40) * 0.1; };
  Case made{{coordinate(), coordinate(), *rc::gen::inRange(-31, 31) * 0.1}, {"loop", {}, 1}};
  Eigen::Vector2d before_m = made.start.position_m();
  for (int i = *rc::gen::inRange(1, 7); i > 0; --i) {
    const Eigen::Vector2d next_m(coordinate(), coordinate());
    if ((next_m - before_m).norm() < 0.2 || (next_m - made.start.position_m()).norm() < 0.2) {
      continue;
    }
    made.path.corners_m.push_back(next_m);
    before_m = next_m;
  }
  if (made.path.corners_m.empty()) made.path.corners_m.push_back(before_m + Eigen::Vector2d(1, 0));
  made.path.rounds = *rc::gen::inRange(1, 4);
  return made;
}

double distance_to_path_m(const Case& of, const Eigen::Vector2d& p_m) {
  double nearest_m = 1e9;
  Eigen::Vector2d a = of.start.position_m();
  for (std::size_t i = 0; i <= of.path.corners_m.size(); ++i) {
    const Eigen::Vector2d b =
        i < of.path.corners_m.size() ? of.path.corners_m[i] : of.start.position_m();
    const double share = std::clamp((p_m - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    nearest_m = std::min(nearest_m, (p_m - a - share * (b - a)).norm());
    a = b;
  }
  return nearest_m;
}

RC_GTEST_PROP(DrivePlan, BeginsAndEndsAtRestAtTheStart, ()) {
  const Case of = any_case();
  const DrivePlan plan(of.start, of.path);
  for (const double t_s : {-1.0, 0.0, plan.duration_s(), plan.duration_s() + 5.0}) {
    const DriveMoment moment = plan.at(t_s);
    RC_ASSERT((moment.pose.position_m() - of.start.position_m()).norm() < 1e-5);
    RC_ASSERT(std::abs(wrap_angle(moment.pose.heading_rad - of.start.heading_rad)) < 1e-6);
    RC_ASSERT(std::abs(moment.speed_mps) < 1e-9);
    RC_ASSERT(std::abs(moment.turn_radps) < 1e-9);
  }
}

RC_GTEST_PROP(DrivePlan, NeverExceedsItsLimits, ()) {
  const Case of = any_case();
  const DriveLimits limits;
  const DrivePlan plan(of.start, of.path, limits);
  DriveMoment before = plan.at(0.0);
  for (double t_s = kSample_s; t_s < plan.duration_s() + 0.1; t_s += kSample_s) {
    const DriveMoment now = plan.at(t_s);
    RC_ASSERT(now.speed_mps >= 0.0);
    RC_ASSERT(now.speed_mps <= limits.speed_mps + 1e-9);
    RC_ASSERT(std::abs(now.turn_radps) <= limits.turn_radps + 1e-9);
    RC_ASSERT(std::abs(now.speed_mps - before.speed_mps) <=
              limits.acceleration_mps2 * kSample_s + 1e-9);
    RC_ASSERT(std::abs(now.turn_radps - before.turn_radps) <=
              limits.turn_acceleration_radps2 * kSample_s + 1e-9);
    before = now;
  }
}

RC_GTEST_PROP(DrivePlan, MovesAsItsSpeedsSay, ()) {
  const Case of = any_case();
  const DrivePlan plan(of.start, of.path);
  DriveMoment before = plan.at(0.0);
  for (double t_s = kSample_s; t_s < plan.duration_s(); t_s += kSample_s) {
    const DriveMoment now = plan.at(t_s);
    const Pose2 moved = compose(inverse(before.pose), now.pose);
    const double gone_m = (before.speed_mps + now.speed_mps) / 2.0 * kSample_s;
    const double turned_rad = (before.turn_radps + now.turn_radps) / 2.0 * kSample_s;
    RC_ASSERT(std::abs(moved.x_m - gone_m) < 3e-5);
    RC_ASSERT(std::abs(moved.y_m) < 3e-5);
    RC_ASSERT(std::abs(wrap_angle(moved.heading_rad - turned_rad)) < 1e-4);
    before = now;
  }
}

RC_GTEST_PROP(DrivePlan, StaysNearItsCorners, ()) {
  const Case of = any_case();
  const DrivePlan plan(of.start, of.path);
  for (double t_s = 0.0; t_s < plan.duration_s(); t_s += 0.05) {
    RC_ASSERT(distance_to_path_m(of, plan.at(t_s).pose.position_m()) < 0.35);
  }
}

TEST(DrivePlan, CutsCornersWithoutStopping) {
  const Path square{"square", {{4.0, 0.0}, {4.0, 4.0}, {0.0, 4.0}}, 2};
  const DrivePlan plan({0.0, 0.0, 0.0}, square);
  EXPECT_LT(plan.length_m(), 32.0);
  EXPECT_GT(plan.length_m(), 30.0);
  int stops = 0;
  bool moving = false;
  for (double t_s = 0.0; t_s < plan.duration_s(); t_s += kSample_s) {
    const bool now_moving = plan.at(t_s).speed_mps > 1e-6;
    stops += moving && !now_moving ? 1 : 0;
    moving = now_moving;
  }
  EXPECT_EQ(stops, 1);  // at the end
}

TEST(DrivePlan, RefusesTwoCornersInOnePlace) {
  EXPECT_THROW(DrivePlan({}, Path{"bad", {{1.0, 0.0}, {1.0, 0.0}}, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace roomwise::simulator
