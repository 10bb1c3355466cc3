// Laws of SlamFilter.
#include "services/ekf_svc/core/slam_filter.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/ekf_svc/support/filter_run.h"

namespace roomwise::ekf {
namespace {

double in_range(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1'000'001) * 1e-6;
}
Eigen::Vector2d arbitrary_point() { return {in_range(-5.0, 5.0), in_range(-5.0, 5.0)}; }
Pose2 arbitrary_pose() { return {in_range(-5.0, 5.0), in_range(-5.0, 5.0), in_range(-2.5, 2.5)}; }

constexpr std::array kForms{ErrorForm::kPlain, ErrorForm::kInvariant};

SlamFilter driven(ErrorForm form, int steps, std::uint64_t seed = 5) {
  KnownIdentityRun run({}, seed);
  SlamFilter filter(form, 64);
  for (int step = 0; step < steps; ++step) run.step({&filter}, {});
  return filter;
}

/// d innovation / d state by central differences, the state being set anew each time.
template <class ResidualAt>
Eigen::MatrixXd numeric_jacobian(const Pose2& pose, const std::vector<Eigen::Vector2d>& points,
                                 ResidualAt residual_at) {
  constexpr double kStep = 1e-6;
  const auto n = static_cast<Eigen::Index>(3 + 2 * points.size());
  const auto innovation = [&](Eigen::Index k, double by) {
    Pose2 p = pose;
    std::vector<Eigen::Vector2d> f = points;
    if (k == 0) p.heading_rad += by;
    if (k == 1) p.x_m += by;
    if (k == 2) p.y_m += by;
    if (k >= 3) f[static_cast<std::size_t>((k - 3) / 2)]((k - 3) % 2) += by;
    return Eigen::Vector2d(residual_at(filter_at(ErrorForm::kInvariant, p, f)).innovation);
  };
  Eigen::MatrixXd jacobian(2, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    jacobian.col(k) = (innovation(k, kStep) - innovation(k, -kStep)) / (2.0 * kStep);
  }
  return jacobian;
}

RC_GTEST_PROP(SlamFilter, ObservationJacobianIsTheNumericOne, ()) {
  const Pose2 pose = arbitrary_pose();
  const std::vector<Eigen::Vector2d> points{arbitrary_point(), arbitrary_point()};
  const BodyObservation seen{arbitrary_point(), Eigen::Matrix2d::Identity()};
  const auto residual_at = [&](const SlamFilter& f) { return f.observation_residual(1, seen); };
  const SlamFilter filter = filter_at(ErrorForm::kInvariant, pose, points);
  const Eigen::MatrixXd H = dense_jacobian(residual_at(filter), filter);
  RC_ASSERT((numeric_jacobian(pose, points, residual_at) + H).cwiseAbs().maxCoeff() < 1e-7);
}

RC_GTEST_PROP(SlamFilter, EqualityJacobianIsTheNumericOne, ()) {
  const Pose2 pose = arbitrary_pose();
  const std::vector<Eigen::Vector2d> points{arbitrary_point(), arbitrary_point(),
                                            arbitrary_point()};
  const auto residual_at = [](const SlamFilter& f) { return f.equality_residual(0, 2, 0.02); };
  const SlamFilter filter = filter_at(ErrorForm::kInvariant, pose, points);
  const Eigen::MatrixXd H = dense_jacobian(residual_at(filter), filter);
  RC_ASSERT((numeric_jacobian(pose, points, residual_at) + H).cwiseAbs().maxCoeff() < 1e-7);
}

// Turning or shifting the whole world must not show in any measurement.
RC_GTEST_PROP(SlamFilter, NoResidualSeesTheWorldTurnOrShift, ()) {
  const SlamFilter filter =
      filter_at(ErrorForm::kInvariant, arbitrary_pose(), {arbitrary_point(), arbitrary_point()});
  const Eigen::VectorXd x = state_of(filter);
  Eigen::MatrixXd unobservable = Eigen::MatrixXd::Zero(x.size(), 3);
  unobservable(0, 0) = 1.0;
  for (Eigen::Index i = 1; i < x.size(); i += 2) {
    unobservable(i, 0) = -x(i + 1);
    unobservable(i + 1, 0) = x(i);
    unobservable.block<2, 2>(i, 1).setIdentity();
  }
  const BodyObservation seen{arbitrary_point(), Eigen::Matrix2d::Identity()};
  for (const Residual& residual :
       {filter.observation_residual(0, seen), filter.equality_residual(0, 1, 0.02)}) {
    RC_ASSERT((dense_jacobian(residual, filter) * unobservable).norm() < 1e-12);
  }
}

RC_GTEST_PROP(SlamFilter, InnovationCovarianceIsThatOfTheFullMatrices, ()) {
  const SlamFilter filter = driven(ErrorForm::kInvariant, 40, 1 + *rc::gen::inRange(0ULL, 9ULL));
  const auto l = *rc::gen::inRange<std::size_t>(0, filter.landmark_count());
  const Residual residual =
      filter.observation_residual(l, {arbitrary_point(), 0.01 * Eigen::Matrix2d::Identity()});
  const Eigen::MatrixXd H = dense_jacobian(residual, filter);
  const Eigen::Matrix2d S = H * covariance_of(filter) * H.transpose() + residual.noise;
  RC_ASSERT((filter.innovation_covariance(residual) - S).cwiseAbs().maxCoeff() < 1e-12);
}

TEST(SlamFilter, CovarianceStaysPositiveDefiniteOnALongRun) {
  for (const ErrorForm form : kForms) {
    KnownIdentityRun run({}, 11);
    SlamFilter filter(form, 64);
    for (int step = 0; step < 4000; ++step) {
      run.step({&filter}, {});
      if (step % 200 != 199) continue;
      const Eigen::LLT<Eigen::MatrixXd> cholesky(covariance_of(filter));
      ASSERT_EQ(cholesky.info(), Eigen::Success) << "step " << step;
    }
  }
}

TEST(SlamFilter, AnUpdateNeverRaisesTheTrace) {
  for (const ErrorForm form : kForms) {
    const auto trace = [form](const SlamFilter& filter) {  // in the coordinates of its error
      return form == ErrorForm::kPlain ? covariance_of(filter).trace()
                                       : invariant_covariance_of(filter).trace();
    };
    KnownIdentityRun run({}, 13);
    SlamFilter filter(form, 64);
    for (int step = 0; step < 300; ++step) {
      run.step({&filter}, {});
      const double before = trace(filter);
      const Residual residual =
          filter.observation_residual(static_cast<std::size_t>(step) % filter.landmark_count(),
                                      {{2.0, 0.1}, 0.01 * Eigen::Matrix2d::Identity()});
      ASSERT_EQ(filter.update({&residual, 1}), UpdateResult::kUsed);
      ASSERT_LE(trace(filter), before + 1e-9);
    }
  }
}

TEST(SlamFilter, ParkedRobotLearnsNothingOfItselfFromNewLandmarks) {
  for (const ErrorForm form : kForms) {
    Eigen::Matrix3d spread = Eigen::Vector3d(0.04, 0.09, 0.01).asDiagonal();
    SlamFilter filter = filter_at(form, {1.0, 2.0, 0.7}, {}, spread);
    const Pose2 pose = filter.pose();
    const Eigen::Matrix3d covariance = filter.pose_covariance();
    std::mt19937_64 engine(1);
    std::normal_distribution<double> noise(0.0, 0.05);
    const BodyObservation seen[] = {{{2.0, 0.5}, 0.0025 * Eigen::Matrix2d::Identity()},
                                    {{1.0, -0.7}, 0.0025 * Eigen::Matrix2d::Identity()}};
    for (const BodyObservation& body : seen) ASSERT_TRUE(filter.add(body, {}));
    for (int look = 0; look < 500; ++look) {
      std::vector<Residual> residuals;
      for (std::size_t l = 0; l < 2; ++l) {
        BodyObservation body = seen[l];
        body.p_robot_m += Eigen::Vector2d(noise(engine), noise(engine));
        residuals.push_back(filter.observation_residual(l, body));
      }
      ASSERT_EQ(filter.update(residuals), UpdateResult::kUsed);
    }
    const double moved_by = (filter.pose().position_m() - pose.position_m()).norm() +
                            std::abs(filter.pose().heading_rad - pose.heading_rad);
    const double surer_by = (filter.pose_covariance() - covariance).cwiseAbs().maxCoeff();
    if (form == ErrorForm::kInvariant) {
      EXPECT_LT(moved_by, 1e-12);
      EXPECT_LT(surer_by, 1e-12);
    } else {
      EXPECT_GT(surer_by, 1e-6);  // the fault the invariant form cures
    }
  }
}

TEST(SlamFilter, TurningAndShiftingTheWorldTurnsAndShiftsTheAnswer) {
  const Pose2 T_new_old{3.0, -2.0, 1.1};
  for (const ErrorForm form : kForms) {
    SlamFilter here(form, 64);
    KnownIdentityRun run({}, 17);
    SlamFilter there(form, 64);
    MotionIncrement to_there;
    to_there.turn_rad = T_new_old.heading_rad;
    to_there.translation_m = T_new_old.position_m();
    there.predict(to_there);
    for (int step = 0; step < 1000; ++step) run.step({&here, &there}, {});
    const Pose2 expected = compose(T_new_old, here.pose());
    EXPECT_LT((there.pose().position_m() - expected.position_m()).norm(), 1e-9);
    EXPECT_NEAR(wrap_angle(there.pose().heading_rad - expected.heading_rad), 0.0, 1e-9);
    for (std::size_t l = 0; l < here.landmark_count(); ++l) {
      const Eigen::Vector2d p = transform(T_new_old, here.landmark_position_m(l));
      EXPECT_LT((there.landmark_position_m(l) - p).norm(), 1e-9);
    }
  }
}

TEST(SlamFilter, RemovingALandmarkOnlyForgetsIt) {
  for (const std::size_t gone : {0U, 3U, 9U}) {
    SlamFilter filter = driven(ErrorForm::kInvariant, 300);
    const std::size_t last = filter.landmark_count() - 1;
    ASSERT_GT(last, 9U);
    const Eigen::MatrixXd P = covariance_of(filter);
    const Eigen::VectorXd x = state_of(filter);
    const std::int64_t last_id = filter.landmark(last).map_id;
    filter.remove(gone);
    ASSERT_EQ(filter.landmark_count(), last);
    EXPECT_EQ(filter.landmark(gone).map_id, last_id);
    const auto old_index = [&](Eigen::Index i) {
      const auto to = static_cast<Eigen::Index>(SlamFilter::kPoseSize + 2 * gone);
      const auto from = static_cast<Eigen::Index>(SlamFilter::kPoseSize + 2 * last);
      return i == to || i == to + 1 ? i - to + from : i;
    };
    const Eigen::MatrixXd kept = covariance_of(filter);
    for (Eigen::Index i = 0; i < kept.rows(); ++i) {
      EXPECT_EQ(state_of(filter)(i), x(old_index(i)));
      for (Eigen::Index j = 0; j < kept.cols(); ++j) {
        ASSERT_EQ(kept(i, j), P(old_index(i), old_index(j)));
      }
    }
  }
}

TEST(SlamFilter, RemovingTheLastLandmarkAndAddingAnotherNeverReusesItsId) {
  SlamFilter filter(ErrorForm::kInvariant, 1);
  const BodyObservation seen{{1.0, 0.0}, 0.01 * Eigen::Matrix2d::Identity()};
  ASSERT_TRUE(filter.add(seen, {}));
  EXPECT_FALSE(filter.add(seen, {}));  // budget
  EXPECT_EQ(filter.landmark_count(), 1U);
  const std::int64_t first = filter.landmark(0).map_id;
  filter.remove(0);
  ASSERT_TRUE(filter.add(seen, {}));
  EXPECT_NE(filter.landmark(0).map_id, first);
}

TEST(SlamFilter, MergeMakesTwoLandmarksOne) {
  SlamFilter filter = driven(ErrorForm::kInvariant, 300);
  // The same object once more, 5 cm beside.
  const Eigen::Vector2d twin =
      transform(inverse(filter.pose()), filter.landmark_position_m(4) + Eigen::Vector2d(0.05, 0.0));
  ASSERT_TRUE(filter.add({twin, 0.01 * Eigen::Matrix2d::Identity()}, {.times_seen = 3}));
  filter.landmark(4).times_seen = 7;
  const std::size_t younger = filter.landmark_count() - 1;
  const std::int64_t kept_id = filter.landmark(4).map_id;
  const double variance = filter.landmark_covariance_m2(4).trace();
  const LandmarkPair pair{.recent = younger, .old = 4};
  ASSERT_EQ(filter.merge({&pair, 1}, 0.02), UpdateResult::kUsed);
  EXPECT_EQ(filter.landmark_count(), younger);
  EXPECT_EQ(filter.landmark(4).map_id, kept_id);
  EXPECT_EQ(filter.landmark(4).times_seen, 10);
  EXPECT_LE(filter.landmark_covariance_m2(4).trace(), variance + 1e-9);
  EXPECT_EQ(Eigen::LLT<Eigen::MatrixXd>(covariance_of(filter)).info(), Eigen::Success);
}

TEST(SlamFilter, EqualityConstraintBringsTheTwoTogether) {
  SlamFilter filter = filter_at(ErrorForm::kInvariant, {}, {{2.0, 1.0}, {2.1, 1.1}});
  const Residual equal = filter.equality_residual(0, 1, 1e-6);
  ASSERT_EQ(filter.update({&equal, 1}), UpdateResult::kUsed);
  EXPECT_LT((filter.landmark_position_m(0) - filter.landmark_position_m(1)).norm(), 1e-6);
  EXPECT_LT((filter.landmark_position_m(0) - Eigen::Vector2d(2.05, 1.05)).norm(), 1e-6);
}

TEST(SlamFilter, UnusableResidualsLeaveItUntouched) {
  SlamFilter filter = driven(ErrorForm::kInvariant, 100);
  const Eigen::VectorXd x = state_of(filter);
  const Eigen::MatrixXd P = covariance_of(filter);
  Residual residual = filter.observation_residual(0, {{1.0, 0.0}, Eigen::Matrix2d::Identity()});
  residual.innovation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(filter.update({&residual, 1}), UpdateResult::kNotFinite);
  residual = filter.observation_residual(0, {{1.0, 0.0}, -10.0 * Eigen::Matrix2d::Identity()});
  EXPECT_EQ(filter.update({&residual, 1}), UpdateResult::kSingular);
  EXPECT_EQ(state_of(filter), x);
  EXPECT_EQ(covariance_of(filter), P);
}

TEST(SlamFilter, SofteningIsNoiseForTheCorrectionAndNothingForTheStatistics) {
  SlamFilter softened = driven(ErrorForm::kInvariant, 100);
  SlamFilter noisier = driven(ErrorForm::kInvariant, 100);
  SlamFilter plain = driven(ErrorForm::kInvariant, 100);
  Residual residual = softened.observation_residual(0, {{1.0, 0.3}, Eigen::Matrix2d::Identity()});
  ASSERT_EQ(plain.update({&residual, 1}), UpdateResult::kUsed);
  residual.softening << 2.0, 0.5, 0.5, 1.0;
  ASSERT_EQ(softened.update({&residual, 1}), UpdateResult::kUsed);
  residual.noise += residual.softening;
  residual.softening.setZero();
  ASSERT_EQ(noisier.update({&residual, 1}), UpdateResult::kUsed);
  EXPECT_LT((state_of(softened) - state_of(noisier)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((covariance_of(softened) - covariance_of(noisier)).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_DOUBLE_EQ(softened.last_innovation().squared, plain.last_innovation().squared);
  EXPECT_GT(softened.last_innovation().squared, noisier.last_innovation().squared);
}

TEST(SlamFilter, WideningThePoseLeavesTheMapAlone) {
  SlamFilter filter = driven(ErrorForm::kInvariant, 100);
  const Eigen::VectorXd x = state_of(filter);
  Eigen::MatrixXd expected = covariance_of(filter);
  expected.diagonal().head<3>() += Eigen::Vector3d(0.04, 0.09, 0.09);
  filter.widen_pose(0.3, 0.2);
  EXPECT_EQ(state_of(filter), x);
  EXPECT_LT((covariance_of(filter) - expected).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace roomwise::ekf
