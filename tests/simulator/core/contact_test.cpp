#include "services/simulator/core/contact.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

namespace roomwise::simulator {
namespace {

using Eigen::Vector2d;

constexpr double kRadius_m = 0.17;

/// A room of 2 m by 2 m round the origin with an inner corner, a thin screen and two pillars.
GroundPlan crowded_room() {
  return {.walls = {{{-1.0, -1.0}, {1.0, -1.0}},
                    {{1.0, -1.0}, {1.0, 1.0}},
                    {{1.0, 1.0}, {-1.0, 1.0}},
                    {{-1.0, 1.0}, {-1.0, -1.0}},
                    {{0.4, 0.3}, {0.9, 0.3}},
                    {{0.4, 0.3}, {0.4, 0.8}},
                    {{-0.6, -0.4}, {-0.6, 0.4}}},
          .discs = {{{0.5, -0.4}, 0.05}, {{0.1, -0.75}, 0.1}},
          .holes = {}};
}

double smallest_gap_m(const GroundPlan& plan, const Vector2d& center_m) {
  std::vector<Touch> touches;
  find_touches(plan, center_m, kRadius_m, 100.0, touches);
  double gap_m = 100.0;
  for (const Touch& touch : touches) gap_m = std::min(gap_m, touch.gap_m);
  return gap_m;
}

RC_GTEST_PROP(Contact, BodyIsNeverInsideAnything, ()) {
  const GroundPlan plan = crowded_room();
  Vector2d center_m(0.0, 0.0);
  for (int leg = 0; leg < 40; ++leg) {
    const double heading = *rc::gen::inRange(0, 6283) * 1e-3;
    const Vector2d step = 0.01 * Vector2d(std::cos(heading), std::sin(heading));
    for (int i = 0; i < 50; ++i) {
      center_m = slide_to(plan, center_m, center_m + step, kRadius_m);
      RC_ASSERT(smallest_gap_m(plan, center_m) > -1e-8);
    }
  }
}

RC_GTEST_PROP(Contact, SlidingNeverAddsWay, ()) {
  const GroundPlan plan = crowded_room();
  Vector2d center_m(0.0, 0.0);
  const double heading = *rc::gen::inRange(0, 6283) * 1e-3;
  const Vector2d step = 0.005 * Vector2d(std::cos(heading), std::sin(heading));
  for (int i = 0; i < 400; ++i) {
    const Vector2d next_m = slide_to(plan, center_m, center_m + step, kRadius_m);
    RC_ASSERT((next_m - center_m).norm() <= 1.01 * step.norm());
    center_m = next_m;
  }
}

TEST(Contact, FreeWayIsTakenWhole) {
  EXPECT_EQ(slide_to(crowded_room(), {0.0, 0.0}, {0.001, 0.002}, kRadius_m),
            Vector2d(0.001, 0.002));
}

TEST(Contact, StopsSquarelyAtAWall) {
  const GroundPlan plan{.walls = {{{1.0, -1.0}, {1.0, 1.0}}}, .discs = {}, .holes = {}};
  const Vector2d stopped = slide_to(plan, {0.82, 0.0}, {0.86, 0.0}, kRadius_m);
  EXPECT_NEAR(stopped.x(), 0.83, 1e-12);
  EXPECT_NEAR(stopped.y(), 0.0, 1e-12);
}

TEST(Contact, SlidesAlongAWall) {
  const GroundPlan plan{.walls = {{{1.0, -1.0}, {1.0, 1.0}}}, .discs = {}, .holes = {}};
  const Vector2d slid = slide_to(plan, {0.83, 0.0}, {0.84, 0.02}, kRadius_m);
  EXPECT_NEAR(slid.x(), 0.83, 1e-12);
  EXPECT_NEAR(slid.y(), 0.02, 1e-12);
}

TEST(Contact, WalkerPushesTheRobotButNeverIntoAWall) {
  GroundPlan plan{.walls = {{{1.0, -1.0}, {1.0, 1.0}}}, .discs = {{{0.0, 0.0}, 0.25}}, .holes = {}};
  Vector2d center_m(0.5, 0.0);
  for (int i = 0; i < 1000; ++i) {
    plan.discs[0].center_m.x() += 0.001;
    center_m = slide_to(plan, center_m, center_m, kRadius_m);
    ASSERT_LT(center_m.x(), 0.83 + 1e-8);
  }
  EXPECT_NEAR(center_m.x(), 0.83, 2e-3) << "pushed as far as it can go";
}

TEST(Contact, TouchSaysWhereTheBodyIs) {
  std::vector<Touch> touches;
  const GroundPlan plan{.walls = {}, .discs = {{{0.0, 0.5}, 0.3}}, .holes = {}};
  find_touches(plan, {0.0, 0.0}, kRadius_m, 0.05, touches);
  ASSERT_EQ(touches.size(), 1U);
  EXPECT_NEAR(touches[0].gap_m, 0.03, 1e-12);
  EXPECT_NEAR(touches[0].direction.y(), 1.0, 1e-12);
}

TEST(Contact, RayEndsAtTheNearestBody) {
  const GroundPlan plan = crowded_room();
  EXPECT_NEAR(free_way_m(plan, {0.0, 0.0}, {-1.0, 0.0}, 5.0), 0.6, 1e-12);
  EXPECT_NEAR(free_way_m(plan, {0.0, -0.4}, {1.0, 0.0}, 5.0), 0.45, 1e-12);
  EXPECT_EQ(free_way_m(plan, {0.0, 0.0}, {-1.0, 0.0}, 0.2), 0.2);
}

TEST(Contact, HolesHaveNoFloor) {
  GroundPlan plan;
  plan.holes = {{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}}, {}};
  EXPECT_TRUE(over_hole(plan, {0.8, 0.5}));
  EXPECT_FALSE(over_hole(plan, {0.2, 0.5}));
}

RC_GTEST_PROP(Contact, WhatIsNearDecidesAlone, ()) {
  const GroundPlan plan = crowded_room();
  const Vector2d point_m(*rc::gen::inRange(-900, 900) * 1e-3, *rc::gen::inRange(-900, 900) * 1e-3);
  GroundPlan near;
  keep_near(plan, point_m, kRadius_m + 0.1, near);
  RC_ASSERT(near.walls.size() + near.discs.size() <= plan.walls.size() + plan.discs.size());
  std::vector<Touch> of_all;
  std::vector<Touch> of_near;
  find_touches(plan, point_m, kRadius_m, 0.1, of_all);
  find_touches(near, point_m, kRadius_m, 0.1, of_near);
  RC_ASSERT(of_all.size() == of_near.size());
}

}  // namespace
}  // namespace roomwise::simulator
