#include "services/pilot_svc/core/goal.h"

#include <gtest/gtest.h>

#include <limits>

namespace roomwise::pilot {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(Goal, StopIsAlwaysSound) { EXPECT_TRUE(is_sound({.speed_mps = kNaN})); }

TEST(Goal, NumbersThatCannotBeMeantAreRefused) {
  EXPECT_TRUE(is_sound({.behaviour = Behaviour::kWander}));
  EXPECT_FALSE(is_sound({.behaviour = Behaviour::kWander, .speed_mps = kNaN}));
  EXPECT_FALSE(is_sound({.behaviour = Behaviour::kWander, .speed_mps = 0.6}));
  EXPECT_FALSE(is_sound({.behaviour = Behaviour::kWander, .duration_s = -1.0}));
  EXPECT_TRUE(is_sound({.behaviour = Behaviour::kGoTo, .x_m = 3.0}));
  EXPECT_FALSE(is_sound({.behaviour = Behaviour::kGoTo, .y_m = kNaN}));
  EXPECT_TRUE(is_sound({.behaviour = Behaviour::kCircle}));
  EXPECT_FALSE(is_sound({.behaviour = Behaviour::kCircle, .circle_sense = 0}));
  EXPECT_FALSE(is_sound({.behaviour = Behaviour::kCircle, .circle_distance_m = 0.1}));
  EXPECT_FALSE(is_sound({.behaviour = Behaviour::kCircle, .circle_rounds = 0.0}));
}

}  // namespace
}  // namespace roomwise::pilot
