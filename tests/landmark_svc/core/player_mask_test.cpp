#include "services/landmark_svc/core/player_mask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "services/landmark_svc/core/landmark_detector.h"
#include "tests/support/synthetic_room.h"

namespace roomwise::landmark {
namespace {

constexpr int kMaskWidth_px = 64;
constexpr int kMaskHeight_px = 48;

/// An image with a player in columns [begin, end).
std::vector<std::uint8_t> player_in(int begin_px, int end_px) {
  std::vector<std::uint8_t> players(static_cast<std::size_t>(kMaskWidth_px) * kMaskHeight_px, 0);
  for (int v = 0; v < kMaskHeight_px; ++v) {
    const auto row = players.begin() + v * kMaskWidth_px;
    std::fill(row + begin_px, row + end_px, std::uint8_t{5});
  }
  return players;
}

Landmark landmark_at(LandmarkKind kind, double u_px) {
  Landmark landmark;
  landmark.kind = kind;
  landmark.u_px = u_px;
  landmark.v_top_px = 10.0;
  landmark.v_bottom_px = 30.0;
  return landmark;
}

TEST(PlayerMask, OfAnEdgeTheNearSideCounts) {
  const auto players = player_in(20, 30);
  EXPECT_TRUE(is_on_player(landmark_at(LandmarkKind::kEdgeLeft, 19.5), players, kMaskWidth_px));
  EXPECT_FALSE(is_on_player(landmark_at(LandmarkKind::kEdgeRight, 19.5), players, kMaskWidth_px));
  EXPECT_TRUE(is_on_player(landmark_at(LandmarkKind::kEdgeRight, 29.5), players, kMaskWidth_px));
  EXPECT_FALSE(is_on_player(landmark_at(LandmarkKind::kEdgeLeft, 29.5), players, kMaskWidth_px));
}

TEST(PlayerMask, OfWhatHasNoFarSideBothSidesCount) {
  const auto players = player_in(20, 30);
  for (const LandmarkKind kind :
       {LandmarkKind::kPole, LandmarkKind::kCreaseConvex, LandmarkKind::kCreaseConcave}) {
    EXPECT_TRUE(is_on_player(landmark_at(kind, 25.0), players, kMaskWidth_px));
    EXPECT_FALSE(is_on_player(landmark_at(kind, 35.0), players, kMaskWidth_px));
  }
}

TEST(PlayerMask, HalfOfItsRowsAreNotMost) {
  auto players = player_in(20, 30);
  std::fill(players.begin() + 20 * kMaskWidth_px, players.end(),
            std::uint8_t{0});  // rows 10..19 of 10..30
  EXPECT_FALSE(is_on_player(landmark_at(LandmarkKind::kEdgeLeft, 19.5), players, kMaskWidth_px));
  std::fill(players.begin() + 20 * kMaskWidth_px, players.begin() + 21 * kMaskWidth_px,
            std::uint8_t{1});
  EXPECT_TRUE(is_on_player(landmark_at(LandmarkKind::kEdgeLeft, 19.5), players, kMaskWidth_px));
}

TEST(PlayerMask, ALeaningEdgeIsFollowed) {
  std::vector<std::uint8_t> players(static_cast<std::size_t>(kMaskWidth_px) * kMaskHeight_px, 0);
  for (int v = 0; v < kMaskHeight_px; ++v)
    players[static_cast<std::size_t>(v * kMaskWidth_px + v)] = 1;
  Landmark leaning = landmark_at(LandmarkKind::kEdgeLeft, 19.5);
  EXPECT_FALSE(is_on_player(leaning, players, kMaskWidth_px));
  leaning.column_slope = 1.0;
  EXPECT_TRUE(is_on_player(leaning, players, kMaskWidth_px));
}

TEST(PlayerMask, WhatReachesOutOfTheImageIsLookedAtWithinIt) {
  const auto players = player_in(0, kMaskWidth_px);
  for (const double u_px : {-3.5, -0.5, 63.5, 70.0}) {
    Landmark landmark = landmark_at(LandmarkKind::kPole, u_px);
    landmark.v_top_px = -20.0;
    landmark.v_bottom_px = 100.0;
    EXPECT_EQ(is_on_player(landmark, players, kMaskWidth_px), u_px > -1.0 && u_px < 64.0) << u_px;
  }
}

/// The furnished room, and what a person who stands in it makes of it.
class StandingPerson : public testing::Test {
 protected:
  StandingPerson() {
    SyntheticRoom room = furnished_room();
    const SyntheticCamera camera{.noise_quanta = 0.0};
    const Pose2 T_world_robot{0.2, -0.2, 0.05};
    const RgbdFrame without = render(room, camera, T_world_robot, 0);
    room.boxes.push_back({{1.3, -0.4, 0.0}, {1.5, -0.05, 1.7}});
    frame_ = render(room, camera, T_world_robot, 0);
    players_.resize(frame_.depth.size());
    for (std::size_t i = 0; i < players_.size(); ++i) {
      players_[i] = frame_.depth.steps[i] != without.depth.steps[i] ? 3 : 0;
    }
  }

  bool stands_there(const Landmark& landmark) const {
    const auto u = static_cast<int>(std::lround(landmark.u_px));
    const auto v = static_cast<int>(0.5 * (landmark.v_top_px + landmark.v_bottom_px));
    int on_person = 0;
    for (int k = -4; k <= 4; ++k) {
      const auto pixel = static_cast<std::size_t>(v * frame_.depth.width_px + u + k);
      on_person += players_.at(pixel) != 0 ? 1 : 0;
    }
    return on_person >= 3 && landmark.range_m < 1.4;
  }

  RgbdFrame frame_;
  std::vector<std::uint8_t> players_;
};

TEST_F(StandingPerson, IsNoFurnitureWhereTheCameraKnowsHim) {
  LandmarkDetector detector({});
  ASSERT_EQ(detector.detect(frame_), DetectResult::kOk);
  const std::vector<Landmark> before = detector.landmarks();
  frame_.players = players_;
  ASSERT_EQ(detector.detect(frame_), DetectResult::kOk);
  const std::vector<Landmark>& after = detector.landmarks();
  ASSERT_EQ(after.size(), before.size());
  int on_person = 0;
  int elsewhere = 0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    EXPECT_FALSE(before[i].is_moving);
    EXPECT_EQ(after[i].is_moving, stands_there(after[i])) << after[i].u_px;
    EXPECT_EQ(after[i].range_m, before[i].range_m);
    (stands_there(after[i]) ? on_person : elsewhere) += 1;
  }
  EXPECT_GE(on_person, 2);
  EXPECT_GE(elsewhere, 2);
}

TEST_F(StandingPerson, PlayersOfAnotherSizeAreNoFrame) {
  frame_.players.assign(players_.size() - 1, 0);
  EXPECT_EQ(LandmarkDetector({}).detect(frame_), DetectResult::kBadImage);
}

}  // namespace
}  // namespace roomwise::landmark
