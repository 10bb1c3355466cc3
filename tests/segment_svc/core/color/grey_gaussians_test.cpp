#include "services/segment_svc/core/color/grey_gaussians.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace roomwise::segment {
namespace {

GreyHistogram histogram_of(const std::vector<std::uint8_t>& greys) {
  GreyHistogram histogram{};
  for (const std::uint8_t grey : greys) ++histogram[grey];
  return histogram;
}

/// One round of the four-line algorithm, as written: T = (m1 + m2) / 2.
double next_threshold(const std::vector<std::uint8_t>& greys, double threshold) {
  double above = 0.0;
  double not_above = 0.0;
  int n_above = 0;
  int n_not_above = 0;
  for (const std::uint8_t grey : greys) {
    (grey > threshold ? above : not_above) += grey;
    ++(grey > threshold ? n_above : n_not_above);
  }
  if (n_above == 0 || n_not_above == 0) return threshold;
  return 0.5 * (above / n_above + not_above / n_not_above);
}

RC_GTEST_PROP(IterativeThreshold, IsAFixedPoint, ()) {
  const auto greys = *rc::gen::nonEmpty<std::vector<std::uint8_t>>();
  const double threshold = iterative_threshold(histogram_of(greys));
  RC_ASSERT(std::abs(next_threshold(greys, threshold) - threshold) < 1e-9);
}

TEST(IterativeThreshold, LiesMidwayBetweenTwoPeaks) {
  GreyHistogram histogram{};
  histogram[20] = 900;
  histogram[200] = 100;
  EXPECT_DOUBLE_EQ(iterative_threshold(histogram), 110.0);
  EXPECT_DOUBLE_EQ(grey_statistics(histogram, GreyStatistics::kAverage)->mean_levels, 38.0);
}

TEST(IterativeThreshold, OfOneLevelIsThatLevel) {
  GreyHistogram histogram{};
  histogram[77] = 5;
  EXPECT_DOUBLE_EQ(iterative_threshold(histogram), 77.0);
  EXPECT_THROW(static_cast<void>(iterative_threshold(GreyHistogram{})), std::invalid_argument);
}

RC_GTEST_PROP(GreyStatistics, AverageIsMeanAndStandardDeviation, ()) {
  const auto greys =
      *rc::gen::container<std::vector<std::uint8_t>>(50, rc::gen::arbitrary<std::uint8_t>());
  double mean = 0.0;
  for (const std::uint8_t grey : greys) mean += grey / 50.0;
  double variance = 0.0;
  for (const std::uint8_t grey : greys) variance += (grey - mean) * (grey - mean) / 50.0;
  const auto learned = grey_statistics(histogram_of(greys), GreyStatistics::kAverage);
  RC_ASSERT(learned.has_value());
  RC_ASSERT(std::abs(learned->mean_levels - mean) < 1e-9);
  RC_ASSERT(std::abs(learned->sigma_levels - std::max(kSigmaMin_levels, std::sqrt(variance))) <
            1e-9);
}

TEST(GreyStatistics, OnePixelIsNoTrainingSet) {
  EXPECT_FALSE(grey_statistics(histogram_of({9}), GreyStatistics::kAverage));
  EXPECT_FALSE(grey_statistics(histogram_of({9}), GreyStatistics::kThreshold));
}

/// p(class | grey) of every class, with the densities and priors of the thesis written out.
std::array<double, 3> posterior(double grey, const GreyClassifier::Gaussians& gaussians) {
  std::array<double, 3> p{};
  double evidence = 0.0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const double sigma = gaussians[k].sigma_levels;
    const double off = grey - gaussians[k].mean_levels;
    p[k] = std::exp(-off * off / (2.0 * sigma * sigma)) /
           (sigma * std::sqrt(2.0 * std::numbers::pi)) / 3.0;
    evidence += p[k];
  }
  for (double& value : p) value /= evidence;
  return p;
}

RC_GTEST_PROP(GreyClassifier, TakesTheMostProbableClass, ()) {
  GreyClassifier::Gaussians gaussians;
  for (GreyGaussian& gaussian : gaussians) {
    gaussian.mean_levels = *rc::gen::inRange(0, 256);
    gaussian.sigma_levels = 8.0 + *rc::gen::inRange(0, 60);  // so that no density is 0 everywhere
  }
  const GreyClassifier classifier(gaussians);
  for (int grey = 0; grey < 256; ++grey) {
    const auto p = posterior(grey, gaussians);
    const auto chosen = std::find(kTrainedClasses.begin(), kTrainedClasses.end(),
                                  classifier.classify(static_cast<std::uint8_t>(grey)));
    const double p_chosen = p[static_cast<std::size_t>(chosen - kTrainedClasses.begin())];
    for (const double other : p) RC_ASSERT(p_chosen >= other * (1.0 - 1e-9));
  }
}

TEST(GreyLevel, OfGreyIsItself) {
  for (int level = 0; level < 256; ++level) {
    const auto l = static_cast<std::uint8_t>(level);
    EXPECT_EQ(grey_level(l, l, l), l);
  }
}

}  // namespace
}  // namespace roomwise::segment
