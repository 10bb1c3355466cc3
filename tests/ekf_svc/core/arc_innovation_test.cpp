// Innovations of a robot that hardly knows its heading.
#include "services/ekf_svc/core/arc_innovation.h"

#include <gtest/gtest.h>

#include "services/ekf_svc/core/association.h"
#include "services/ekf_svc/core/planar_group.h"

namespace roomwise::ekf {
namespace {

constexpr double kOff_rad = 0.7;
constexpr double kHeadingSigma_rad = 0.35;
constexpr double kRangeSigma_m = 0.05;
constexpr double kAcrossSigma_m = 0.02;

/// Seen at `p`, with its range known less well than its bearing.
BodyObservation seen_at(const Eigen::Vector2d& p) {
  const Eigen::Vector2d along = p.normalized(), across = quarter_turn(along);
  return {p, kRangeSigma_m * kRangeSigma_m * along * along.transpose() +
                 kAcrossSigma_m * kAcrossSigma_m * across * across.transpose()};
}

class ArcInnovation : public testing::Test {
 protected:
  ArcInnovation() { EXPECT_TRUE(filter_.add(seen_at(landmark_), {})); }
  Residual chord(const BodyObservation& seen) const {
    return filter_.observation_residual(0, seen);
  }
  /// What a robot sees that turned and does not know of it.
  BodyObservation seen_after(double turn_rad) const {
    return seen_at(rotation2(-turn_rad) * landmark_);
  }
  double squared(const Residual& residual) const {
    return mahalanobis_sq(residual.innovation, filter_.innovation_covariance(residual));
  }

  Eigen::Vector2d landmark_{3.0, 1.0};
  SlamFilter filter_{ErrorForm::kInvariant, 4};
};

TEST_F(ArcInnovation, ATurnIsNoErrorOfTheRange) {
  filter_.widen_pose(1e-3, kHeadingSigma_rad);
  const BodyObservation seen = seen_after(kOff_rad);
  const Residual arc = unrolled(filter_, chord(seen), seen);
  EXPECT_NEAR(arc.innovation.dot(landmark_.normalized()), 0.0, 1e-12);
  EXPECT_NEAR(arc.innovation.norm(), landmark_.norm() * kOff_rad, 1e-12);
  const double turns_sq = kOff_rad / kHeadingSigma_rad * kOff_rad / kHeadingSigma_rad;
  EXPECT_NEAR(squared(arc), turns_sq, 0.05);
  EXPECT_GT(squared(chord(seen)), 25.0);  // the straight line would be refused
}

TEST_F(ArcInnovation, TheHeadingIsFoundInOneUpdate) {
  filter_.widen_pose(1e-3, kHeadingSigma_rad);
  const BodyObservation seen = seen_after(kOff_rad);
  const Residual arc = unrolled(filter_, chord(seen), seen);
  ASSERT_EQ(filter_.update({&arc, 1}), UpdateResult::kUsed);
  EXPECT_NEAR(filter_.pose().heading_rad, kOff_rad, 0.01);
  EXPECT_LT(filter_.pose().position_m().norm(), 0.01);
}

TEST_F(ArcInnovation, NoiseTurnsWithTheLineOfSight) {
  filter_.widen_pose(1e-3, kHeadingSigma_rad);
  const BodyObservation seen = seen_after(kOff_rad);
  const Residual arc = unrolled(filter_, chord(seen), seen);
  EXPECT_LT((arc.noise - seen_at(landmark_).covariance_m2).norm(), 1e-12);
}

TEST_F(ArcInnovation, NearlyStraightItIsTheChord) {
  filter_.widen_pose(1e-3, kHeadingSigma_rad);
  const BodyObservation seen = seen_after(0.09);
  EXPECT_EQ(unrolled(filter_, chord(seen), seen).innovation, chord(seen).innovation);
}

TEST_F(ArcInnovation, WhereThePlaceIsInDoubtItIsTheChord) {
  filter_.widen_pose(1.0, 1e-3);
  const BodyObservation seen = seen_after(kOff_rad);
  EXPECT_EQ(unrolled(filter_, chord(seen), seen).innovation, chord(seen).innovation);
}

}  // namespace
}  // namespace roomwise::ekf
