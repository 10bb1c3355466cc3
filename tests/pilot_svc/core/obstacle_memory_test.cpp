#include "services/pilot_svc/core/obstacle_memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace roomwise::pilot {
namespace {

constexpr Duration kFrame = std::chrono::milliseconds(33);
constexpr std::size_t kBins = 9;
constexpr double kBin_rad = 1e-3;  // all end in the same cell
constexpr Time kNow = time_from_utime(1'000'000'000);

class ObstacleMemoryTest : public testing::Test {
 protected:
  bool see(double free_m, double obstacle_m = 0.0, double unknown = 0.0) {
    // The middle bins are well within the view; those at the edges see nothing end.
    std::vector<double> free(kBins, 5.0);
    const std::vector<double> ratio(kBins, unknown);
    for (std::size_t k = kBins / 2 - 1; k <= kBins / 2 + 1; ++k) free[k] = free_m;
    const std::vector<double> obstacle(kBins, obstacle_m);
    const FreeView view{kBin_rad, kBin_rad, free, ratio, obstacle};
    for (int frame = 0; frame < 4; ++frame) {
      now_ += kFrame;
      if (!memory_.see(now_, {}, view)) return false;
    }
    return true;
  }
  std::vector<Eigen::Vector2d> points(const Pose2& T_odom_robot = {}) {
    std::vector<Eigen::Vector2d> result;
    memory_.obstacles_round(now_, T_odom_robot, result);
    return result;
  }
  PilotParams params_;
  ObstacleMemory memory_{params_};
  Time now_ = kNow;
};

TEST_F(ObstacleMemoryTest, WhatEndsTheFreeRangeStandsThere) {
  ASSERT_TRUE(see(1.5));
  ASSERT_EQ(points().size(), 1U);
  EXPECT_NEAR(points()[0].x(), 1.525, 0.05);
  EXPECT_NEAR(points({1.0, 0.0, std::acos(0.0)})[0].y(), -0.525, 0.05);
}

TEST_F(ObstacleMemoryTest, FloorSeenWhereItStoodOpensThePlace) {
  ASSERT_TRUE(see(1.5));
  ASSERT_TRUE(see(2.5));
  ASSERT_EQ(points().size(), 1U);
  EXPECT_NEAR(points()[0].x(), 2.525, 0.05);
}

TEST_F(ObstacleMemoryTest, FadesAfterItsTime) {
  ASSERT_TRUE(see(1.5));
  now_ += std::chrono::seconds(59);
  EXPECT_EQ(points().size(), 1U);
  now_ += std::chrono::seconds(2);
  EXPECT_TRUE(points().empty());
}

TEST_F(ObstacleMemoryTest, SomethingTooNearToBeMeasuredIsGuessedOnlyWhereNothingIsRemembered) {
  ASSERT_TRUE(see(0.0));
  ASSERT_EQ(points().size(), 1U);
  EXPECT_NEAR(points()[0].x(), 0.625, 0.05);
  ASSERT_TRUE(see(0.0));
  EXPECT_EQ(points().size(), 1U);
}

TEST_F(ObstacleMemoryTest, WhatIsSeenToStandBeforeAllFloorInViewIsNotGuessed) {
  for (const double stands_m : {0.525, 0.975}) {
    memory_.forget();
    ASSERT_TRUE(see(0.0, stands_m));
    ASSERT_EQ(points().size(), 1U);
    EXPECT_NEAR(points()[0].x(), stands_m, 0.026);
  }
}

TEST_F(ObstacleMemoryTest, WhatIsSeenALittleBehindTheFloorsEndStandsWhereItIsSeen) {
  ASSERT_TRUE(see(1.5, 1.825));
  ASSERT_EQ(points().size(), 1U);
  EXPECT_NEAR(points()[0].x(), 1.825, 0.026);
}

TEST_F(ObstacleMemoryTest, WhatIsSeenFarBehindTheFloorsEndDoesNotOpenTheWayToIt) {
  ASSERT_TRUE(see(1.5, 2.5));
  ASSERT_EQ(points().size(), 1U);
  EXPECT_NEAR(points()[0].x(), 1.525, 0.05);
  memory_.forget();
  ASSERT_TRUE(see(0.0, 2.5));
  ASSERT_EQ(points().size(), 1U);
  EXPECT_NEAR(points()[0].x(), 0.625, 0.05);
}

TEST_F(ObstacleMemoryTest, OneSightingOrOneBinAloneTurnsNobodyAside) {
  const std::vector<double> known(kBins, 0.0);
  const std::vector<double> nothing(kBins, 0.0);
  std::vector<double> lone(kBins, 5.0);
  lone[kBins / 2] = 1.5;
  const std::vector<double> wide(kBins, 1.5);
  for (int i = 0; i < 5; ++i)
    ASSERT_TRUE(memory_.see(now_ += kFrame, {}, {0.0, 0.02, lone, known, nothing}));
  EXPECT_TRUE(points().empty());
  ASSERT_TRUE(memory_.see(now_ += kFrame, {}, {0.0, 0.02, wide, known, nothing}));
  EXPECT_TRUE(points().empty());
  ASSERT_TRUE(memory_.see(now_ += kFrame, {}, {0.0, 0.02, wide, known, nothing}));
  EXPECT_FALSE(points().empty());
}

TEST_F(ObstacleMemoryTest, AtTheViewsEdgesEndsSayNothing) {
  const std::vector<double> known{1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0};
  const std::vector<double> nothing(11, 0.0);
  const std::vector<double> ends{0.0, 1.0, 1.0, 1.0, 5.0, 5.0, 5.0, 1.0, 1.0, 1.0, 0.0};
  for (int i = 0; i < 5; ++i)
    ASSERT_TRUE(memory_.see(now_ += kFrame, {}, {-0.1, 0.02, ends, known, nothing}));
  EXPECT_TRUE(points().empty());
}

TEST_F(ObstacleMemoryTest, WhereItWasRefusedSomethingStandsUntilTheFloorIsSeenThere) {
  memory_.refuse(now_, {1.5, 0.0});
  EXPECT_EQ(points().size(), 1U);
  ASSERT_TRUE(see(2.5));
  ASSERT_EQ(points().size(), 1U);
  EXPECT_GT(points()[0].x(), 2.0);
}

TEST_F(ObstacleMemoryTest, ABearingOutOfViewSaysNothing) {
  ASSERT_TRUE(see(0.0, 0.8, 1.0));
  EXPECT_TRUE(points().empty());
}

TEST_F(ObstacleMemoryTest, NumbersThatAreNoViewAreRefused) {
  EXPECT_FALSE(see(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(memory_.see(now_, {}, {}));
  const std::vector<double> two{1.0, 1.0};
  const std::vector<double> one{0.0};
  EXPECT_FALSE(memory_.see(now_, {}, {0.0, 0.02, two, one, two}));
  EXPECT_FALSE(memory_.see(now_, {}, {0.0, 0.02, two, two, one}));
  EXPECT_FALSE(memory_.see(now_, {}, {1e300, 0.02, one, one, one}));
  EXPECT_TRUE(points().empty());
}

}  // namespace
}  // namespace roomwise::pilot
