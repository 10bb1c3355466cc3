#include "services/pilot_svc/core/circle.h"

#include <gtest/gtest.h>

#include <vector>

namespace roomwise::pilot {
namespace {

class CircleTest : public testing::Test {
 protected:
  Step step() { return circle_.step({now_, {}, object_m_, memory_, visits_}); }

  PilotParams params_;
  Circle circle_{{.behaviour = Behaviour::kCircle, .circle_distance_m = 0.5}, params_};
  ObstacleMemory memory_{params_};
  VisitMemory visits_;
  std::vector<Eigen::Vector2d> object_m_{{0.6, 0.0}};
  Time now_ = time_from_utime(1'000'000);
};

TEST_F(CircleTest, WhereItIsNotLetGoItLooksFirst) {
  EXPECT_FALSE(circle_.look_toward({}, {0.1, 0.3}));  // not round it yet
  (void)step();
  ASSERT_TRUE(circle_.look_toward({}, {0.1, 0.3}));
  EXPECT_EQ(step().motion.speed_mps, 0.0);
  EXPECT_GT(step().motion.turn_rate_radps, 0.5);
  EXPECT_TRUE(circle_.look_toward({}, {0.1, -0.3}));  // still looking
  EXPECT_GT(step().motion.turn_rate_radps, 0.5);
}

TEST_F(CircleTest, WhatIsInViewAnywayIsNoReasonToLook) {
  (void)step();
  EXPECT_FALSE(circle_.look_toward({}, {0.3, 0.05}));
}

}  // namespace
}  // namespace roomwise::pilot
