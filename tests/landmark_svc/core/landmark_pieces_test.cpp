#include "services/landmark_svc/core/landmark_pieces.h"

#include <gtest/gtest.h>

namespace roomwise::landmark {
namespace {

Landmark landmark_at(double range_m, double bearing_rad, double low_m, double high_m, int rows) {
  Landmark landmark;
  landmark.range_m = range_m;
  landmark.bearing_rad = bearing_rad;
  landmark.covariance << 4e-4, 0.0, 0.0, 2.5e-5;
  landmark.height_low_m = low_m;
  landmark.height_high_m = high_m;
  landmark.rows = rows;
  landmark.score_ratio = rows / (rows + 20.0);
  return landmark;
}

std::vector<Landmark> joined(std::vector<Landmark> landmarks) {
  RejectCounts rejected;
  const std::size_t before = landmarks.size();
  join_pieces(landmarks, 9.21, rejected);
  EXPECT_EQ(static_cast<std::size_t>(rejected.of(RejectReason::kLandmarkMerged)),
            before - landmarks.size());
  return landmarks;
}

TEST(LandmarkPieces, OneAboveTheOtherAreAveragedByRows) {
  const auto result =
      joined({landmark_at(2.00, 0.100, 0.0, 0.4, 30), landmark_at(2.04, 0.104, 0.5, 1.0, 90)});
  ASSERT_EQ(result.size(), 1u);
  EXPECT_NEAR(result[0].range_m, 2.03, 1e-4);
  EXPECT_NEAR(result[0].bearing_rad, 0.103, 1e-4);
  EXPECT_EQ(result[0].height_low_m, 0.0);
  EXPECT_EQ(result[0].height_high_m, 1.0);
  EXPECT_EQ(result[0].rows, 120);
}

TEST(LandmarkPieces, AcrossTheBackTheBearingWraps) {
  const auto result =
      joined({landmark_at(2.0, 3.140, 0.0, 0.4, 50), landmark_at(2.0, -3.140, 0.5, 1.0, 50)});
  ASSERT_EQ(result.size(), 1u);
  EXPECT_GT(std::abs(result[0].bearing_rad), 3.1414);
}

TEST(LandmarkPieces, SideBySideTheBetterStays) {
  const auto result =
      joined({landmark_at(2.00, 0.100, 0.0, 1.0, 30), landmark_at(2.02, 0.104, 0.1, 1.0, 90)});
  ASSERT_EQ(result.size(), 1u);
  EXPECT_EQ(result[0].range_m, 2.02);
}

TEST(LandmarkPieces, DifferentKindsOrPlacesStayApart) {
  Landmark right = landmark_at(2.0, 0.1, 0.0, 1.0, 30);
  right.kind = LandmarkKind::kEdgeRight;
  EXPECT_EQ(joined({landmark_at(2.0, 0.1, 0.0, 1.0, 30), right}).size(), 2u);
  EXPECT_EQ(
      joined({landmark_at(2.0, 0.1, 0.0, 1.0, 30), landmark_at(2.2, 0.1, 0.0, 1.0, 30)}).size(),
      2u);
}

TEST(LandmarkPieces, BudgetKeepsTheBestFromLeftToRight) {
  std::vector<Landmark> landmarks = {landmark_at(2.0, -0.2, 0, 1, 40),
                                     landmark_at(2.0, 0.0, 0, 1, 20),
                                     landmark_at(2.0, 0.2, 0, 1, 60)};
  RejectCounts rejected;
  keep_best(landmarks, 2, rejected);
  ASSERT_EQ(landmarks.size(), 2u);
  EXPECT_EQ(landmarks[0].bearing_rad, 0.2);
  EXPECT_EQ(landmarks[1].bearing_rad, -0.2);
  EXPECT_EQ(rejected.of(RejectReason::kLandmarkOverBudget), 1);
}

}  // namespace
}  // namespace roomwise::landmark
