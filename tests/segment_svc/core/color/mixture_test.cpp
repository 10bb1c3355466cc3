#include "services/segment_svc/core/color/mixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace roomwise::segment {
namespace {

/// Samples of a round Gaussian; sums of twelve draws, so that they are the same everywhere.
void add_samples(const ColorFeature& mean, double sigma, int count, std::mt19937& random,
                 std::vector<ColorFeature>& samples) {
  for (int i = 0; i < count; ++i) {
    ColorFeature x = mean;
    for (int axis = 0; axis < 3; ++axis) {
      double sum = -6.0;
      for (int draw = 0; draw < 12; ++draw) sum += static_cast<double>(random()) * 0x1p-32;
      x[axis] += sigma * sum;
    }
    samples.push_back(x);
  }
}

std::vector<ColorFeature> two_clusters() {
  std::mt19937 random(3);
  std::vector<ColorFeature> samples;
  add_samples({0.0, 0.0, 4.0}, 0.1, 600, random, samples);
  add_samples({0.8, -0.5, 5.0}, 0.2, 200, random, samples);
  return samples;
}

TEST(Mixture, FindsTheGaussiansThatSamplesWereDrawnFrom) {
  const auto mixture = fit_mixture(two_clusters(), 2);
  ASSERT_TRUE(mixture);
  std::vector<MixturePart> parts = mixture->parts();
  std::sort(parts.begin(), parts.end(),
            [](const auto& a, const auto& b) { return a.weight_ratio < b.weight_ratio; });
  EXPECT_NEAR(parts[0].weight_ratio, 0.25, 0.01);
  EXPECT_LT((parts[0].mean - ColorFeature(0.8, -0.5, 5.0)).norm(), 0.05);
  EXPECT_LT((parts[1].mean - ColorFeature(0.0, 0.0, 4.0)).norm(), 0.02);
  EXPECT_NEAR(std::sqrt(parts[0].covariance(0, 0)), 0.2, 0.03);
  EXPECT_NEAR(std::sqrt(parts[1].covariance(2, 2)), 0.1, 0.01);
}

TEST(Mixture, NumberOfPartsIsChosenByTheInformationCriterion) {
  const auto best = fit_best_mixture(two_clusters(), 5);
  ASSERT_TRUE(best);
  EXPECT_EQ(best->parts().size(), 2U);
}

TEST(Mixture, SameSamplesAndSeedGiveTheSameBits) {
  const auto one = fit_mixture(two_clusters(), 3, {.seed = 5});
  const auto other = fit_mixture(two_clusters(), 3, {.seed = 5});
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(one->parts()[k].mean, other->parts()[k].mean);
    EXPECT_EQ(one->parts()[k].covariance, other->parts()[k].covariance);
  }
}

TEST(Mixture, MoreIterationsNeverMakeSamplesLessLikely) {
  const auto samples = two_clusters();
  double before = -1e9;
  for (int iterations = 1; iterations < 12; ++iterations) {
    const MixtureFit fit{.iterations_max = iterations, .variance_min = 0.0};
    const double now = mean_log_likelihood(*fit_mixture(samples, 3, fit), samples);
    EXPECT_GE(now, before - 1e-9);
    before = now;
  }
}

TEST(Mixture, SurvivesSamplesOfOneColourAndTooFewOfThem) {
  const std::vector<ColorFeature> same(100, ColorFeature(0.1, 0.2, 3.0));
  const auto mixture = fit_mixture(same, 3);
  ASSERT_TRUE(mixture);
  EXPECT_TRUE(std::isfinite(mean_log_likelihood(*mixture, same)));
  EXPECT_FALSE(fit_mixture(std::span(same).first(29), 3));
  EXPECT_FALSE(fit_mixture(same, 0));
}

TEST(Mixture, FarOffSamplesHaveAFiniteLogLikelihood) {
  const Mixture mixture(std::vector<MixturePart>{
      {.mean = {0, 0, 4}, .covariance = 1e-4 * Eigen::Matrix3d::Identity()}});
  EXPECT_LT(mixture.log_likelihood({100, 0, 4}), -1e7);
  EXPECT_TRUE(std::isfinite(mixture.log_likelihood({100, 0, 4})));
}

TEST(Mixture, PartThatIsNoGaussianIsRefused) {
  using Parts = std::vector<MixturePart>;
  EXPECT_THROW(Mixture(Parts{}), std::invalid_argument);
  EXPECT_THROW(Mixture(Parts{{.covariance = -Eigen::Matrix3d::Identity()}}), std::invalid_argument);
  EXPECT_THROW(Mixture(Parts{{.weight_ratio = 0.0}}), std::invalid_argument);
}

}  // namespace
}  // namespace roomwise::segment
