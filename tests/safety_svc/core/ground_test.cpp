// What is known of the floor, and of the corridor over it.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <span>

#include "tests/safety_svc/support/driven_world.h"

namespace roomwise::safety {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Instant kSeen{seconds(100), time_from_utime(1'700'000'000'000'000)};

constexpr double kOwn_m = 0.22;  // what the robot and its margin take up

Instant seen_later(Duration time) { return {kSeen.steady + time, kSeen.wall + time}; }

/// A view of 21 bearings of 2 degrees, all alike.
struct UniformView {
  UniformView(double free, double unknown, double obstacle = 0.0)
      : free_m(21, free), unknown_ratio(21, unknown), obstacle_m(21, obstacle) {}
  FreeView view() const {
    return {.first_bearing_rad = -0.35,
            .bearing_step_rad = 0.035,
            .free_range_m = free_m,
            .unknown_ratio = unknown_ratio,
            .obstacle_range_m = obstacle_m,
            .floor_seen_from_m = 0.7};
  }
  std::vector<double> free_m;
  std::vector<double> unknown_ratio;
  std::vector<double> obstacle_m;
};

TEST(ObstacleMemory, TellsFreeClosedOverlookedAndUnknown) {
  ObstacleMemory memory;
  ASSERT_TRUE(memory.see(kSeen, {}, UniformView(1.52, 0.1).view(), kOwn_m));
  EXPECT_EQ(memory.at(kSeen, {1.0, 0.0}).ground, Ground::kFree);
  EXPECT_EQ(memory.at(kSeen, {0.72, 0.0}).ground, Ground::kFree);
  EXPECT_EQ(memory.at(kSeen, {0.6, 0.0}).ground, Ground::kOverlooked);
  EXPECT_EQ(memory.at(kSeen, {1.52, 0.0}).ground, Ground::kClosed);
  EXPECT_EQ(memory.at(kSeen, {1.57, 0.0}).ground, Ground::kClosed);
  EXPECT_EQ(memory.at(kSeen, {1.52, 0.0}).why, Reason::kObstacle);
  EXPECT_EQ(memory.at(kSeen, {1.68, 0.0}).ground, Ground::kUnknown);
  EXPECT_EQ(memory.at(kSeen, {-1.0, 0.0}).ground, Ground::kUnknown);
  EXPECT_EQ(memory.at(kSeen, {1.0 - 6.4, 0.0}).ground, Ground::kUnknown) << "the same cell";
}

TEST(ObstacleMemory, Fades) {
  ObstacleMemory memory;
  ASSERT_TRUE(memory.see(kSeen, {}, UniformView(1.52, 0.1).view(), kOwn_m));
  EXPECT_EQ(memory.at(seen_later(kFreeLife), {1.0, 0.0}).ground, Ground::kFree);
  EXPECT_EQ(memory.at(seen_later(kFreeLife + Duration(1)), {1.0, 0.0}).ground, Ground::kOverlooked);
  EXPECT_EQ(memory.at(seen_later(std::chrono::hours(1)), {1.0, 0.0}).ground, Ground::kOverlooked);
  EXPECT_EQ(memory.at(seen_later(kCameraAge), {1.52, 0.0}).why, Reason::kObstacle);
  EXPECT_EQ(memory.at(seen_later(kCameraAge + Duration(1)), {1.52, 0.0}).why, Reason::kRemembered);
  EXPECT_EQ(memory.at(seen_later(kClosedLife), {1.52, 0.0}).ground, Ground::kClosed);
  EXPECT_EQ(memory.at(seen_later(kClosedLife + Duration(1)), {1.52, 0.0}).ground, Ground::kUnknown);
}

TEST(ObstacleMemory, OnlySeeingTheFloorOpensWhatWasClosed) {
  ObstacleMemory memory;
  ASSERT_TRUE(memory.see(kSeen, {}, UniformView(1.52, 0.1).view(), kOwn_m));
  const Pose2 nearer{1.0, 0.0, 0.0};  // now 0.52 m ahead, in the blind zone
  ASSERT_TRUE(memory.see(kSeen, nearer, UniformView(2.0, 0.1).view(), kOwn_m));
  EXPECT_EQ(memory.at(kSeen, {1.52, 0.0}).ground, Ground::kClosed);
  ASSERT_TRUE(memory.see(kSeen, {}, UniformView(2.0, 0.1).view(), kOwn_m));
  EXPECT_EQ(memory.at(kSeen, {1.52, 0.0}).ground, Ground::kFree);
}

TEST(ObstacleMemory, WhereNoFloorComesIntoViewItDoubtsWhatItKnew) {
  ObstacleMemory memory;
  ASSERT_TRUE(memory.see(kSeen, {-0.6, 0.0, 0.0}, UniformView(2.4, 0.1).view(), kOwn_m));
  ASSERT_EQ(memory.at(kSeen, {0.3, 0.0}).ground, Ground::kFree);
  ASSERT_TRUE(memory.see(kSeen, {}, UniformView(0.0, 0.1).view(), kOwn_m));
  EXPECT_EQ(memory.at(kSeen, {0.3, 0.0}).ground, Ground::kFree) << "no reading is that near";
  EXPECT_EQ(memory.at(kSeen, {0.6, 0.0}).ground, Ground::kUnknown);
  EXPECT_EQ(memory.at(kSeen, {1.2, 0.0}).ground, Ground::kFree);
  ASSERT_TRUE(memory.see(kSeen, {}, UniformView(0.0, 0.9).view(), kOwn_m));
  EXPECT_EQ(memory.at(kSeen, {0.3, 0.0}).ground, Ground::kUnknown);
  EXPECT_EQ(memory.at(kSeen, {1.2, 0.0}).ground, Ground::kUnknown);
}

TEST(ObstacleMemory, BeforeSomethingClosedThatExplainsTheViewItOnlyOverlooks) {
  ObstacleMemory memory;
  ASSERT_TRUE(memory.see(kSeen, {-0.8, 0.0, 0.0}, UniformView(1.52, 0.1).view(), kOwn_m));
  ASSERT_EQ(memory.at(kSeen, {0.72, 0.0}).ground, Ground::kClosed);
  ASSERT_TRUE(memory.see(kSeen, {}, UniformView(0.0, 0.1).view(), kOwn_m));
  EXPECT_EQ(memory.at(kSeen, {0.3, 0.0}).ground, Ground::kFree) << "no reading is that near";
  EXPECT_EQ(memory.at(kSeen, {0.6, 0.0}).ground, Ground::kOverlooked);
  EXPECT_EQ(memory.at(kSeen, {0.72, 0.0}).ground, Ground::kClosed);
  EXPECT_EQ(memory.at(kSeen, {0.78, 0.0}).ground, Ground::kClosed) << "the cell behind the edge";
  ASSERT_TRUE(memory.see(kSeen, {}, UniformView(0.0, 0.9).view(), kOwn_m));
  EXPECT_EQ(memory.at(kSeen, {0.6, 0.0}).ground, Ground::kUnknown)
      << "what stands that far off would be measured";
}

TEST(ObstacleMemory, WhereSomethingIsSeenToHideTheFloorOnlyWhatLiesFromThereOnIsInDoubt) {
  ObstacleMemory memory;
  ASSERT_TRUE(memory.see(kSeen, {-0.6, 0.0, 0.0}, UniformView(2.4, 0.1).view(), kOwn_m));
  ASSERT_EQ(memory.at(kSeen, {0.48, 0.0}).ground, Ground::kFree);
  ASSERT_TRUE(memory.see(kSeen, {}, UniformView(0.0, 0.1, 0.62).view(), kOwn_m));
  EXPECT_EQ(memory.at(kSeen, {0.48, 0.0}).ground, Ground::kFree);
  EXPECT_EQ(memory.at(kSeen, {0.62, 0.0}).ground, Ground::kUnknown);
  EXPECT_EQ(memory.at(kSeen, {0.78, 0.0}).ground, Ground::kUnknown);
  EXPECT_EQ(memory.at(kSeen, {1.2, 0.0}).ground, Ground::kFree);
}

TEST(ObstacleMemory, BeforeWhatIsSeenToHideTheFloorTheUnknownIsOverlooked) {
  const auto ground_before = [](const FreeView& view, double range_m) {
    ObstacleMemory memory;
    EXPECT_TRUE(memory.see(kSeen, {}, view, kOwn_m));
    return memory.at(kSeen, {range_m, 0.0}).ground;
  };
  const UniformView wall(0.0, 0.1, 0.62);
  EXPECT_EQ(ground_before(wall.view(), 0.28), Ground::kOverlooked);
  EXPECT_EQ(ground_before(wall.view(), 0.53), Ground::kOverlooked);
  EXPECT_EQ(ground_before(wall.view(), 0.62), Ground::kUnknown);
  const UniformView none(0.0, 0.1);
  EXPECT_EQ(ground_before(none.view(), 0.28), Ground::kUnknown);
  const UniformView near(0.0, 0.1, 0.78);
  EXPECT_EQ(ground_before(near.view(), 0.28), Ground::kOverlooked);
  const UniformView far(0.0, 0.1, 0.82);
  EXPECT_EQ(ground_before(far.view(), 0.28), Ground::kUnknown) << "it does not hide the floor";
  const UniformView dark(0.0, 0.9, 0.62);
  EXPECT_EQ(ground_before(dark.view(), 0.28), Ground::kUnknown);
  FreeView drop_off = wall.view();
  drop_off.has_drop_off = true;
  EXPECT_EQ(ground_before(drop_off, 0.28), Ground::kUnknown);
}

TEST(ObstacleMemory, InTheDarkBeforeSomethingTooNearToBeMeasuredItOnlyOverlooks) {
  const auto dark_before = [](double wall_m) {
    ObstacleMemory memory;
    EXPECT_TRUE(memory.see(kSeen, {-1.2, 0.0, 0.0}, UniformView(1.2 + wall_m, 0.1).view(), kOwn_m));
    EXPECT_EQ(memory.at(kSeen, {wall_m, 0.0}).ground, Ground::kClosed);
    EXPECT_EQ(memory.at(kSeen, {0.36, 0.0}).ground, Ground::kFree);
    EXPECT_TRUE(memory.see(kSeen, {}, UniformView(0.0, 0.9).view(), kOwn_m));
    EXPECT_EQ(memory.at(kSeen, {wall_m, 0.0}).ground, Ground::kClosed);
    EXPECT_EQ(memory.at(kSeen, {wall_m + 0.2, 0.0}).ground, Ground::kUnknown);
    return memory.at(kSeen, {0.36, 0.0}).ground;
  };
  EXPECT_EQ(dark_before(0.42), Ground::kOverlooked);
  EXPECT_EQ(dark_before(0.52), Ground::kOverlooked) << "two cells beyond the nearest reading";
  EXPECT_EQ(dark_before(0.57), Ground::kUnknown);
}

TEST(ObstacleMemory, InTheDarkTheRobotsOwnRoomIsNotInDoubt) {
  ObstacleMemory memory;
  memory.overlook_round(kSeen, {}, 0.45);
  ASSERT_TRUE(memory.see(kSeen, {}, UniformView(0.0, 0.9).view(), kOwn_m));
  EXPECT_EQ(memory.at(kSeen, {0.22, 0.0}).ground, Ground::kOverlooked);
  EXPECT_EQ(memory.at(kSeen, {0.28, 0.0}).ground, Ground::kUnknown);
}

TEST(ObstacleMemory, ANarrowShadowIsNothingTooNearToBeMeasured) {
  ObstacleMemory memory;
  ASSERT_TRUE(memory.see(kSeen, {-0.6, 0.0, 0.0}, UniformView(2.4, 0.1).view(), kOwn_m));
  UniformView shadow(2.0, 0.1);
  const std::size_t middle = shadow.free_m.size() / 2;
  const auto darken = [&](std::size_t bin) {
    shadow.free_m[bin] = 0.0;
    shadow.unknown_ratio[bin] = 0.9;
  };
  for (std::size_t bin = middle - 2; bin <= middle + 1; ++bin) darken(bin);
  ASSERT_TRUE(memory.see(kSeen, {}, shadow.view(), kOwn_m));
  EXPECT_EQ(memory.at(kSeen, {1.2, 0.0}).ground, Ground::kFree) << "0.14 rad";
  darken(middle + 2);
  ASSERT_TRUE(memory.see(kSeen, {}, shadow.view(), kOwn_m));
  EXPECT_EQ(memory.at(kSeen, {1.2, 0.0}).ground, Ground::kUnknown) << "0.175 rad";
}

TEST(ObstacleMemory, AtTheViewsEdgesNothingIsClosed) {
  ObstacleMemory memory;
  UniformView seen(2.0, 0.1);
  for (const std::size_t bin : {std::size_t{2}, seen.free_m.size() - 3}) seen.free_m[bin] = 1.0;
  const FreeView view = seen.view();
  const auto place = [&](std::size_t bin) {
    const double bearing_rad =
        view.first_bearing_rad + view.bearing_step_rad * static_cast<double>(bin);
    return Eigen::Vector2d(1.01 * std::cos(bearing_rad), 1.01 * std::sin(bearing_rad));
  };
  ASSERT_TRUE(memory.see(kSeen, {}, view, kOwn_m));
  EXPECT_NE(memory.at(kSeen, place(2)).ground, Ground::kClosed);
  EXPECT_NE(memory.at(kSeen, place(seen.free_m.size() - 3)).ground, Ground::kClosed);
  for (const std::size_t bin : {std::size_t{3}, seen.free_m.size() - 4}) seen.free_m[bin] = 1.0;
  ASSERT_TRUE(memory.see(kSeen, {}, seen.view(), kOwn_m));
  EXPECT_EQ(memory.at(kSeen, place(3)).ground, Ground::kClosed);
  EXPECT_EQ(memory.at(kSeen, place(seen.free_m.size() - 4)).ground, Ground::kClosed);
}

TEST(ObstacleMemory, AtTheEdgesOfWhatWasEverInViewNothingIsDoubted) {
  ObstacleMemory memory;
  ASSERT_TRUE(memory.see(kSeen, {-0.6, 0.0, 0.0}, UniformView(2.4, 0.1).view(), kOwn_m));
  ASSERT_TRUE(memory.see(kSeen, {}, UniformView(0.0, 0.1).view(), kOwn_m));
  const auto ground_along = [&](int bin) {
    const double bearing_rad = 0.035 * bin - 0.35;
    return memory.at(kSeen, {0.78 * std::cos(bearing_rad), 0.78 * std::sin(bearing_rad)}).ground;
  };
  for (const int bin : {1, 19}) EXPECT_EQ(ground_along(bin), Ground::kFree) << bin;
  for (const int bin : {4, 16}) EXPECT_EQ(ground_along(bin), Ground::kUnknown) << bin;
}

TEST(ObstacleMemory, WhatWasNeverSeenNothingExplains) {
  ObstacleMemory memory;
  memory.touch(kSeen, {0.3, 0.0, 0.0}, 0.17, Reason::kRemembered);
  ASSERT_EQ(memory.at(kSeen, {0.53, 0.0}).ground, Ground::kClosed);
  ASSERT_TRUE(memory.see(kSeen, {}, UniformView(0.0, 0.1).view(), kOwn_m));
  EXPECT_EQ(memory.at(kSeen, {0.48, 0.0}).ground, Ground::kUnknown);
}

TEST(ObstacleMemory, WhatWasFeltIsTwoCellsThick) {
  ObstacleMemory memory;
  memory.touch(kSeen, {}, 0.17, Reason::kRemembered);
  EXPECT_EQ(memory.at(kSeen, {0.19, 0.0}).ground, Ground::kUnknown);
  EXPECT_EQ(memory.at(kSeen, {0.23, 0.0}).ground, Ground::kClosed);
  EXPECT_EQ(memory.at(kSeen, {0.27, 0.0}).ground, Ground::kClosed);
  EXPECT_EQ(memory.at(kSeen, {0.31, 0.0}).ground, Ground::kUnknown);
}

TEST(ObstacleMemory, WhereTheViewEndsWhereItBeginsNoFloorIsSeen) {
  ObstacleMemory memory;
  const UniformView seen(0.72, 0.1);
  FreeView view = seen.view();
  view.floor_seen_from_m = 0.72;
  ASSERT_TRUE(memory.see(kSeen, {}, view, kOwn_m));
  EXPECT_EQ(memory.at(kSeen, {0.72, 0.0}).ground, Ground::kUnknown) << "not closed";
}

TEST(ObstacleMemory, BeyondItsReachNothingIsClosed) {
  ObstacleMemory memory;
  ASSERT_TRUE(memory.see(kSeen, {}, UniformView(ObstacleMemory::kReach_m, 0.1).view(), kOwn_m));
  EXPECT_EQ(memory.at(kSeen, {2.48, 0.0}).ground, Ground::kFree);
  EXPECT_EQ(memory.at(kSeen, {2.52, 0.0}).ground, Ground::kUnknown);
}

TEST(ObstacleMemory, ABearingOfWhichHalfIsReadIsNotDark) {
  ObstacleMemory memory;
  ASSERT_TRUE(memory.see(kSeen, {}, UniformView(1.52, kUnknownRatio).view(), kOwn_m));
  EXPECT_EQ(memory.at(kSeen, {1.52, 0.0}).why, Reason::kObstacle);
}

TEST(ObstacleMemory, AnEdgeToFallOffIsSaidToBeOne) {
  ObstacleMemory memory;
  const UniformView seen(1.52, 0.1);
  FreeView view = seen.view();
  view.has_drop_off = true;
  ASSERT_TRUE(memory.see(kSeen, {}, view, kOwn_m));
  EXPECT_EQ(memory.at(kSeen, {1.52, 0.0}).why, Reason::kDropOff);
  ASSERT_TRUE(memory.see(kSeen, {}, UniformView(1.52, 0.9).view(), kOwn_m));
  EXPECT_EQ(memory.at(kSeen, {1.52, 0.0}).why, Reason::kUnknown);
}

TEST(ObstacleMemory, WithNothingInViewNothingChanges) {
  ObstacleMemory memory;
  ASSERT_TRUE(memory.see(kSeen, {}, UniformView(1.52, 0.1).view(), kOwn_m));
  ASSERT_TRUE(memory.see(kSeen, {}, UniformView(0.9, 1.0).view(), kOwn_m));
  EXPECT_EQ(memory.at(kSeen, {1.52, 0.0}).ground, Ground::kClosed);
}

TEST(Reason, HasWords) {
  EXPECT_EQ(words_of(Reason::kAsAsked), "as asked");
  EXPECT_EQ(words_of(Reason::kCharging), "charging");
  EXPECT_EQ(ReasonSet().first(), Reason::kAsAsked);
}

TEST(ObstacleMemory, RefusesWhatIsNoView) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  ObstacleMemory memory;
  const UniformView good(1.0, 0.1);
  const auto sees = [&](auto change) {
    FreeView view = good.view();
    change(view);
    return memory.see(kSeen, {}, view, kOwn_m);
  };
  EXPECT_TRUE(sees([](auto&) {}));
  EXPECT_FALSE(sees([](auto& v) { v.free_range_m = {}; }));
  EXPECT_FALSE(sees([](auto& v) { v.unknown_ratio = v.unknown_ratio.first(20); }));
  EXPECT_FALSE(sees([](auto& v) { v.obstacle_range_m = v.obstacle_range_m.first(20); }));
  EXPECT_FALSE(sees([](auto& v) { v.first_bearing_rad = -1.5; })) << "1.5 is too far";
  EXPECT_TRUE(sees([](auto& v) { v.first_bearing_rad = -1.49; }));
  EXPECT_TRUE(sees([](auto& v) { v.bearing_step_rad = 1.83 / 20; })) << "its last is at 1.48";
  EXPECT_FALSE(sees([](auto& v) {
    v.first_bearing_rad = 0.5;
    v.bearing_step_rad = 0.05;
  })) << "its last is at 1.5";
  EXPECT_FALSE(sees([](auto& v) { v.bearing_step_rad = 0.1; }));
  EXPECT_FALSE(sees([&](auto& v) { v.bearing_step_rad = nan; }));
  UniformView bad = good;
  bad.free_m[3] = nan;
  EXPECT_FALSE(memory.see(kSeen, {}, bad.view(), kOwn_m));
  bad = good;
  bad.unknown_ratio[3] = nan;
  EXPECT_FALSE(memory.see(kSeen, {}, bad.view(), kOwn_m));
  bad = good;
  bad.obstacle_m[3] = nan;
  EXPECT_FALSE(memory.see(kSeen, {}, bad.view(), kOwn_m));
  const std::vector<double> many(1001, 0.5);
  const auto sees_many = [&](std::size_t bins) {
    return sees([&](auto& v) {
      v.free_range_m = v.unknown_ratio = v.obstacle_range_m = std::span(many).first(bins);
      v.bearing_step_rad = 1e-4;
    });
  };
  EXPECT_TRUE(sees_many(1000));
  EXPECT_FALSE(sees_many(1001));
}

TEST(ObstacleMemory, OverlooksWhatIsUnknownInACircleAndNothingElse) {
  ObstacleMemory memory;
  memory.overlook_round(kSeen, {}, 0.45);
  EXPECT_EQ(memory.at(kSeen, {0.0, -0.4}).ground, Ground::kOverlooked);
  EXPECT_EQ(memory.at(kSeen, {-0.42, -0.42}).ground, Ground::kUnknown) << "a corner of the square";
  ASSERT_TRUE(memory.see(kSeen, {-1.0, 0.0, 0.0}, UniformView(2.0, 0.1).view(), kOwn_m));
  ASSERT_EQ(memory.at(kSeen, {0.3, 0.0}).ground, Ground::kFree);
  memory.overlook_round(kSeen, {}, 0.45);
  EXPECT_EQ(memory.at(kSeen, {0.3, 0.0}).ground, Ground::kFree);
}

TEST(SweptCorridor, SaysHowMuchOfItIsUnknown) {
  ObstacleMemory memory;
  EXPECT_EQ(sweep(kSeen, memory, {}, 0.0, 0.5, {}).unknown_ratio, 1.0);
  ASSERT_TRUE(memory.see(kSeen, {-1.0, 0.0, 0.0}, UniformView(2.0, 0.1).view(), kOwn_m));
  EXPECT_LT(sweep(kSeen, memory, {}, 0.0, 0.5, {}).unknown_ratio, 0.01);
}

TEST(SweptCorridor, MeetsWhatStandsThereWhereverThatIs) {
  for (const double x_m : {-5.0, 0.0, 5.0}) {
    for (const double y_m : {-5.0, 0.0, 5.0}) {
      const Pose2 here{x_m, y_m, 0.3};
      ObstacleMemory memory;
      memory.overlook_round(kSeen, here, 0.45);
      EXPECT_GT(sweep(kSeen, memory, here, 0.0, 0.1, {}).free_m, 0.09);
      memory.touch(kSeen, here, 0.17, Reason::kRemembered);
      EXPECT_EQ(sweep(kSeen, memory, here, 0.0, 0.1, {}).end, Reason::kRemembered);
    }
  }
}

TEST(SweptCorridor, OfNoLengthNothingIsUnknown) {
  const ObstacleMemory memory;
  const CorridorView view = sweep(kSeen, memory, {}, 0.0, 0.0, {});
  EXPECT_EQ(view.free_m, 0.0);
  EXPECT_EQ(view.unknown_ratio, 0.0);
}

}  // namespace
}  // namespace roomwise::safety
