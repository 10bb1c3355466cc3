#include "services/simulator/core/truth.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "services/simulator/core/scene_furniture.h"

namespace roomwise::simulator {
namespace {

constexpr int kConvexCrease = 3;
constexpr int kConcaveCrease = 4;
constexpr int kPoleCenter = 5;

Scene scene_of(const std::vector<Solid>& solids) {
  Scene scene;
  for (const Solid& solid : solids) add_to(scene, solid, 0, SurfaceClass::kObstacle);
  return scene;
}

std::vector<SceneLandmark> of_kind(const Scene& scene, int kind) {
  auto landmarks = true_landmarks(scene);
  std::erase_if(landmarks, [kind](const SceneLandmark& one) { return one.kind != kind; });
  return landmarks;
}

bool has_at(const std::vector<SceneLandmark>& landmarks, const Eigen::Vector2d& p_m) {
  return std::any_of(landmarks.begin(), landmarks.end(), [&](const SceneLandmark& one) {
    return (one.position_m - p_m).norm() < 1e-6;
  });
}

RC_GTEST_PROP(TrueLandmarks, BoxHasFourConvexCreasesWhereverItStands, ()) {
  const Pose2 pose{*rc::gen::inRange(-50, 50) * 0.1, *rc::gen::inRange(-50, 50) * 0.1,
                   *rc::gen::inRange(-31, 32) * 0.1};
  const Scene scene = scene_of({moved(box({-0.4, -0.3, 0.0}, {0.4, 0.3, 0.9}), pose)});
  const auto landmarks = true_landmarks(scene);
  RC_ASSERT(landmarks.size() == 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    RC_ASSERT(landmarks[i].identity == static_cast<int>(i));
    RC_ASSERT(landmarks[i].kind == kConvexCrease);
    RC_ASSERT(has_at(landmarks, scene.blocks[0].corners_m[i]));
    RC_ASSERT(landmarks[i].low_m == 0.0);
    RC_ASSERT(landmarks[i].high_m == 0.9);
  }
}

TEST(TrueLandmarks, RoomHasFourConcaveCornersInside) {
  std::vector<Solid> solids;
  const std::vector<Eigen::Vector2d> corners{{0, 0}, {4, 0}, {4, 3}, {0, 3}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d along = corners[(i + 1) % 4] - corners[i];
    const Eigen::Vector2d from = corners[i] - 0.05 * along.normalized();
    solids.push_back(moved(wall(along.norm() + 0.1, 0.1, 2.5, {}),
                           {from.x(), from.y(), std::atan2(along.y(), along.x())}));
  }
  const auto concave = of_kind(scene_of(solids), kConcaveCrease);
  EXPECT_EQ(concave.size(), 4U);
  EXPECT_TRUE(has_at(concave, {0.05, 0.05}));
  EXPECT_TRUE(has_at(concave, {3.95, 2.95}));
  EXPECT_EQ(of_kind(scene_of(solids), kConvexCrease).size(), 4U);
}

TEST(TrueLandmarks, CupboardAgainstAWallMakesTwoOfEachKind) {
  const Scene scene = scene_of({wall(4.0, 0.1, 2.5, {}), box({1.0, 0.05, 0.0}, {1.8, 0.5, 1.2})});
  const auto concave = of_kind(scene, kConcaveCrease);
  EXPECT_EQ(concave.size(), 2U);
  EXPECT_TRUE(has_at(concave, {1.0, 0.05}));
  EXPECT_DOUBLE_EQ(concave[0].high_m, 1.2);
  const auto convex = of_kind(scene, kConvexCrease);
  EXPECT_TRUE(has_at(convex, {1.0, 0.5}));
  EXPECT_EQ(convex.size(), 6U);  // and the ends of the wall
}

TEST(TrueLandmarks, BoxesSideBySideMakeNoneInBetween) {
  const auto landmarks =
      true_landmarks(scene_of({box({0, 0, 0}, {1, 1, 1}), box({1, 0, 0}, {2, 1, 1})}));
  EXPECT_EQ(landmarks.size(), 4U);
  EXPECT_FALSE(has_at(landmarks, {1.0, 0.0}));
}

TEST(TrueLandmarks, DoorJambsReachUpToTheLintel) {
  const auto convex =
      of_kind(scene_of({wall(4.0, 0.1, 2.5, {{1.0, 2.0, 0.0, 2.05}})}), kConvexCrease);
  EXPECT_EQ(convex.size(), 8U);
  const auto jamb = std::find_if(convex.begin(), convex.end(), [](const SceneLandmark& one) {
    return (one.position_m - Eigen::Vector2d(1.0, 0.05)).norm() < 1e-6;
  });
  ASSERT_NE(jamb, convex.end());
  EXPECT_DOUBLE_EQ(jamb->high_m, 2.05);
}

TEST(TrueLandmarks, LegsAndThinCylindersArePolesWideOnesNothing) {
  const Scene scene = scene_of({table({1.2, 0.8, 0.74}, 0.04, 0.06),
                                moved(cylinder(0.1, 0.0, 1.0), {3.0, 0.0, 0.0}),
                                moved(cylinder(0.4, 0.0, 1.0), {5.0, 0.0, 0.0})});
  const auto landmarks = true_landmarks(scene);
  EXPECT_EQ(landmarks.size(), 5U);
  EXPECT_EQ(of_kind(scene, kPoleCenter).size(), 5U);
  EXPECT_TRUE(has_at(landmarks, {3.0, 0.0}));
  EXPECT_TRUE(has_at(landmarks, {0.55, 0.35}));
}

TEST(TrueLandmarks, LowThingsPanelsAndWhatLiesBelowTheFloorMakeNone) {
  Solid panel = box({0, 0, 0}, {0.01, 1, 2});
  panel.blocks[0].has_landmarks = false;
  EXPECT_TRUE(true_landmarks(scene_of({box({0, 0, 0}, {1, 1, 0.1}), moved(panel, {3, 0, 0}),
                                       moved(steps_down(5, 0.3, 0.2, 1.0, 2.0), {5, 0, 0})}))
                  .empty());
}

TEST(TrueLandmarks, ShelfBoardsDoNotCutItsUprights) {
  const auto convex = of_kind(scene_of({shelf({0.3, 0.8, 1.8}, 5)}), kConvexCrease);
  const auto front = std::count_if(convex.begin(), convex.end(), [](const SceneLandmark& one) {
    return one.position_m.x() > 0.1 && one.high_m - one.low_m > 1.5;
  });
  EXPECT_EQ(front, 4);  // two corners of each side
}

}  // namespace
}  // namespace roomwise::simulator
