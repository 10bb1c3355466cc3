#include "services/landmark_svc/core/standing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace roomwise::landmark {
namespace {

constexpr std::int64_t kFrame_us = 33'333;

Landmark at(double x_m, double y_m, LandmarkKind kind = LandmarkKind::kEdgeLeft) {
  Landmark landmark;
  landmark.kind = kind;
  landmark.range_m = std::hypot(x_m, y_m);
  landmark.bearing_rad = std::atan2(y_m, x_m);
  return landmark;
}

/// Whether what walks sideways at `speed_mps` is said to have stood, in the last of ten frames.
bool stands(double speed_mps, double range_m) {
  Standing standing;
  for (int i = 0; i < 10; ++i) {
    const double y_m = -0.3 + 1e-6 * speed_mps * static_cast<double>(i * kFrame_us);
    standing.remember(i * kFrame_us, {}, {at(range_m, y_m)});
  }
  const double y_m = -0.3 + 1e-6 * speed_mps * static_cast<double>(10 * kFrame_us);
  return standing.has_stood(10 * kFrame_us, {}, at(range_m, y_m), {});
}

TEST(Standing, TellsWhoWalksFromWhatStands) {
  for (const double range_m : {1.0, 2.0, 3.0}) {
    EXPECT_TRUE(stands(0.0, range_m));
    for (const double speed_mps : {-1.2, -0.64, 0.64, 1.2}) {
      EXPECT_FALSE(stands(speed_mps, range_m)) << speed_mps << " " << range_m;
    }
  }
}

// Who turns a corner stands for a moment: long enough for what has nothing to do with movers.
TEST(Standing, WhoWalkedAndTurnsHasNotStoodYet) {
  const auto stood_after = [](bool was_moving, double distance_m) {
    Standing standing;
    Landmark walker = at(2.5, 0.3);
    walker.is_moving = was_moving;
    standing.remember(0, {}, {walker});
    const Landmark turning = at(2.5, 0.3 + distance_m);
    for (int i = 1; i < 10; ++i) standing.remember(i * kFrame_us, {}, {turning});
    return standing.has_stood(10 * kFrame_us, {}, turning, {});
  };
  EXPECT_FALSE(stood_after(true, 0.2));
  EXPECT_TRUE(stood_after(false, 0.2));
  EXPECT_TRUE(stood_after(true, 0.8)) << "what stands elsewhere is not in doubt";
}

TEST(Standing, WhoTurnsRoundAndComesBackHasNotStood) {
  const auto stood_after = [](double speed_mps) {
    Standing standing;
    const auto place_at = [speed_mps](int i) {
      return at(2.5, 0.3 + 1e-6 * speed_mps * static_cast<double>(kFrame_us * std::abs(10 - i)));
    };
    for (int i = 0; i < 20; ++i) {
      Landmark walker = place_at(i);
      walker.is_moving = i == 0;
      standing.remember(i * kFrame_us, {}, {walker});
    }
    return standing.has_stood(20 * kFrame_us, {}, place_at(20), {});
  };
  for (const double speed_mps : {0.64, 1.1}) EXPECT_FALSE(stood_after(speed_mps)) << speed_mps;
  EXPECT_TRUE(stood_after(0.0));
}

/// Whether what was seen twice, `apart` frames apart, has stood, with another thing 0.3 m beside it
/// that was in doubt in between; `mover` walked by elsewhere a second before, or did not.
bool stands_beside_doubt(bool mover, int apart) {
  Standing standing;
  Landmark passer = at(2.5, -1.5);
  passer.is_moving = mover;
  standing.remember(0, {}, {passer});
  standing.remember(kFrame_us, {}, {passer});
  const Landmark seen = at(2.5, 0.3);
  Landmark doubtful = at(2.5, 0.6, LandmarkKind::kPole);
  standing.remember(31 * kFrame_us, {}, {seen});
  for (int i = 1; i < apart; ++i) standing.remember((31 + i) * kFrame_us, {}, {doubtful});
  doubtful.is_moving = true;
  standing.remember_doubts({doubtful});
  return standing.has_stood((31 + apart) * kFrame_us, {}, seen, {});
}

TEST(Standing, BesideWhatIsInDoubtItTakesLongerWherePeopleWalk) {
  EXPECT_FALSE(stands_beside_doubt(true, 7));
  EXPECT_TRUE(stands_beside_doubt(true, 13));
  EXPECT_TRUE(stands_beside_doubt(false, 7)) << "nothing ever moved here";
}

TEST(Standing, WhereAnythingMovedTheFarMustStandUntilSlowWalkersWouldBeGone) {
  const auto stands_far = [](double speed_mps, int frames_of_passer) {
    Standing standing;
    const auto place_at = [speed_mps](int i) {
      return at(3.8, -0.3 + 1e-6 * speed_mps * static_cast<double>(i * kFrame_us));
    };
    Landmark passer = at(2.5, -1.5);
    passer.is_moving = true;
    for (int i = 0; i < frames_of_passer; ++i) standing.remember(i * kFrame_us, {}, {passer});
    for (int i = 0; i < 10; ++i) standing.remember((31 + i) * kFrame_us, {}, {place_at(i)});
    return standing.has_stood(41 * kFrame_us, {}, place_at(10), {});
  };
  EXPECT_FALSE(stands_far(0.5, 2));
  EXPECT_TRUE(stands_far(0.0, 2));
  EXPECT_TRUE(stands_far(0.5, 1)) << "the mask errs in one frame, walkers show in several";
}

TEST(Standing, WhatMovedOnceIsTakenForStandingInTheEnd) {
  Standing standing;
  Landmark chair = at(2.5, 0.3);
  chair.is_moving = true;
  standing.remember(0, {}, {chair});
  chair.is_moving = false;
  for (int i = 1; i < 25; ++i) standing.remember(i * kFrame_us, {}, {chair});
  EXPECT_TRUE(standing.has_stood(25 * kFrame_us, {}, chair, {}));
}

TEST(Standing, FollowsTheRobotsOwnMotion) {
  Standing standing;
  const Eigen::Vector2d post_m(2.5, 0.4);
  for (int i = 0; i < 10; ++i) {
    const Pose2 pose{0.02 * i, 0.0, 0.01 * i};
    const Eigen::Vector2d seen_m = transform(inverse(pose), post_m);
    const Landmark landmark = at(seen_m.x(), seen_m.y());
    EXPECT_TRUE(standing.has_stood(i * kFrame_us, pose, landmark, {})) << i;
    standing.remember(i * kFrame_us, pose, {landmark});
  }
}

TEST(Standing, WhatHasJustComeIsNotYetKnownToStand) {
  Standing standing;
  for (int i = 0; i < 10; ++i) standing.remember(i * kFrame_us, {}, {at(2.0, 0.0)});
  EXPECT_FALSE(standing.has_stood(10 * kFrame_us, {}, at(2.0, 0.5), {}));
  for (int i = 10; i < 16; ++i) standing.remember(i * kFrame_us, {}, {at(2.0, 0.5)});
  EXPECT_TRUE(standing.has_stood(16 * kFrame_us, {}, at(2.0, 0.5), {}));
}

TEST(Standing, AnotherKindIsNoProof) {
  Standing standing;
  for (int i = 0; i < 10; ++i) standing.remember(i * kFrame_us, {}, {at(2.0, 0.0)});
  EXPECT_FALSE(standing.has_stood(10 * kFrame_us, {}, at(2.0, 0.0, LandmarkKind::kEdgeRight), {}));
}

TEST(Standing, SaysNothingWithoutAMemory) {
  Standing standing;
  EXPECT_TRUE(standing.has_stood(0, {}, at(2.0, 0.0), {}));
  for (int i = 0; i < 3; ++i) standing.remember(i * kFrame_us, {}, {});
  EXPECT_TRUE(standing.has_stood(3 * kFrame_us, {}, at(2.0, 0.0), {}));  // nothing is old enough
  for (int i = 3; i < 9; ++i) standing.remember(i * kFrame_us, {}, {});
  EXPECT_FALSE(standing.has_stood(9 * kFrame_us, {}, at(2.0, 0.0), {}));
  standing.remember(0, {}, {});  // time went back
  EXPECT_TRUE(standing.has_stood(kFrame_us, {}, at(2.0, 0.0), {}));
}

}  // namespace
}  // namespace roomwise::landmark
