#include "services/landmark_svc/core/crease_finder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/landmark_svc/support/plan_scan.h"

namespace roomwise::landmark {
namespace {

constexpr double kNoise_quanta = 0.55;

std::vector<Landmark> creases(const std::function<double(double)>& along_m, std::uint32_t seed) {
  const VirtualScan scan = scan_of_plan(along_m, kNoise_quanta, seed);
  CreaseFinder finder;
  std::vector<Landmark> landmarks;
  RejectCounts rejected;
  finder.find(scan, plan_floor(), kPlanCamera, plan_table(), kPlanWidth_px, {}, landmarks,
              rejected);
  return landmarks;
}

/// Two walls that meet at a right angle `along_m` ahead, the corner turned by `turned_rad`.
double room_corner(double x, double along_m, double turned_rad, bool is_convex) {
  const double a = std::sin(M_PI / 4 + turned_rad);
  const double b = std::cos(M_PI / 4 + turned_rad);
  const double one = line_at(x, a, b, b * along_m);
  const double two = line_at(x, -b, a, a * along_m);
  return is_convex ? std::max(one, two) : std::min(one, two);
}

class Corner : public testing::TestWithParam<bool> {};

TEST_P(Corner, IsWhereTheWallsMeetFromNearAndFar) {
  const bool is_convex = GetParam();
  for (const double along_m : {1.2, 2.0, 2.8, 3.4}) {
    for (const double turned_rad : {-0.3, 0.0, 0.3}) {
      const auto found =
          creases([&](double x) { return room_corner(x, along_m, turned_rad, is_convex); }, 7);
      ASSERT_EQ(found.size(), 1u) << along_m << " " << turned_rad;
      EXPECT_EQ(found[0].kind,
                is_convex ? LandmarkKind::kCreaseConvex : LandmarkKind::kCreaseConcave);
      EXPECT_NEAR(found[0].range_m, along_m, 0.02);
      EXPECT_NEAR(found[0].bearing_rad * along_m, 0.0, 0.02);
      const double error_m = found[0].range_m - along_m;
      EXPECT_LT(error_m * error_m, 9.0 * found[0].covariance(0, 0));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(CreaseFinder, Corner, testing::Bool());

TEST(CreaseFinder, AFlatWallHasNone) {
  for (const double turned : {-1.5, -0.5, 0.0, 0.5, 1.5}) {
    for (std::uint32_t seed = 0; seed < 5; ++seed) {
      EXPECT_TRUE(creases([&](double x) { return line_at(x, turned, 1.0, 2.5); }, seed).empty());
    }
  }
}

TEST(CreaseFinder, TheLegOfATableBeforeItsDrawersIsNone) {
  // A leg 6 cm wide stands 4 cm before a front that goes on to one side of it.
  for (const double away_m : {1.5, 2.2, 2.8, 3.4, 3.7}) {
    for (const double side : {-1.0, 1.0}) {
      for (std::uint32_t seed = 0; seed < 5; ++seed) {
        const auto found = creases(
            [&](double x) {
              const double aside_m = side * x * away_m;
              if (aside_m > 0.0 && aside_m < 0.06) return away_m - 0.04;
              return aside_m >= 0.06 ? 3.95 : away_m;
            },
            seed);
        EXPECT_TRUE(found.empty()) << away_m << " " << side;
      }
    }
  }
}

TEST(CreaseFinder, RoundThingsHaveNone) {
  for (const double radius_m : {0.10, 0.17, 0.25, 0.40}) {
    for (const double away_m : {1.5, 2.2, 2.8, 3.4}) {
      for (std::uint32_t seed = 0; seed < 5; ++seed) {
        const auto found = creases(
            [&](double x) { return std::min(3.9, circle_at(x, 0.05, away_m, radius_m)); }, seed);
        EXPECT_TRUE(found.empty()) << radius_m << " " << away_m << " " << seed;
      }
    }
  }
}

TEST(CreaseFinder, AStepInAWallHasNone) {
  for (const double step_m : {0.02, 0.04, 0.06, 0.12}) {
    for (const double away_m : {1.2, 2.0, 3.0}) {
      const auto found = creases([&](double x) { return x > 0.1 ? away_m : away_m + step_m; }, 11);
      EXPECT_TRUE(found.empty()) << step_m << " " << away_m;
    }
  }
}

}  // namespace
}  // namespace roomwise::landmark
