#include "services/pilot_svc/core/glance.h"

#include <gtest/gtest.h>

#include <vector>

namespace roomwise::pilot {
namespace {

class GlanceTest : public testing::Test {
 protected:
  /// Turns as it is told for so long.
  void turn_for(double time_s) {
    constexpr double kStep_s = 0.02;
    for (int i = 0; i < static_cast<int>(time_s / kStep_s) && glance_.is_on(); ++i) {
      now_ += Duration(20'000);
      T_odom_robot_.heading_rad += kStep_s * glance_.step(now_, T_odom_robot_).turn_rate_radps;
    }
  }

  bool begin(const Eigen::Vector2d& p_robot_m) {
    return glance_.begin(now_, T_odom_robot_, p_robot_m, obstacles_robot_m_);
  }

  std::vector<Eigen::Vector2d> obstacles_robot_m_;
  PilotParams params_;
  Glance glance_{params_};
  Time now_ = time_from_utime(1'000'000);
  Pose2 T_odom_robot_;
};

TEST_F(GlanceTest, FacesThePlaceStaysAWhileAndEnds) {
  ASSERT_TRUE(begin({0.1, -0.3}));
  turn_for(1.0);
  EXPECT_TRUE(glance_.is_on());
  turn_for(4.0);
  EXPECT_FALSE(glance_.is_on());
  EXPECT_NEAR(T_odom_robot_.heading_rad, std::atan2(-0.3, 0.1), 0.1);
}

TEST_F(GlanceTest, WhatIsInViewAnywayIsNotLookedAt) { EXPECT_FALSE(begin({0.3, 0.05})); }

TEST_F(GlanceTest, NotTowardWhatStandsSoNearThatItIsNotMeasured) {
  obstacles_robot_m_ = {{0.0, -0.5}, {0.0, 0.7}};
  EXPECT_FALSE(begin({0.0, -0.3}));
  EXPECT_TRUE(begin({0.0, 0.3}));
}

TEST_F(GlanceTest, TheSamePlaceIsNotLookedAtAgainSoSoon) {
  ASSERT_TRUE(begin({0.0, 0.3}));
  turn_for(5.0);
  T_odom_robot_ = {};
  EXPECT_FALSE(begin({0.05, 0.25}));
  EXPECT_TRUE(begin({0.0, -0.3}));
  turn_for(5.0);
  now_ += std::chrono::seconds(60);
  T_odom_robot_ = {};
  EXPECT_TRUE(begin({0.0, -0.3}));
}

TEST_F(GlanceTest, EndsThoughItIsNotLetTurn) {
  ASSERT_TRUE(begin({0.0, 0.3}));
  now_ += std::chrono::seconds(7);
  (void)glance_.step(now_, T_odom_robot_);
  EXPECT_FALSE(glance_.is_on());
}

}  // namespace
}  // namespace roomwise::pilot
