#include "services/ekf_svc/core/covariance_sweep.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "services/ekf_svc/core/covariance_store.h"

namespace roomwise::ekf {
namespace {

TEST(CovarianceSweep, EqualsTheSumOfOuterProductsForEverySize) {
  std::mt19937_64 engine(7);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  for (std::size_t n = 1; n < 50; ++n) {
    const std::size_t pairs = n % 5;
    CovarianceStore store(n);
    AlignedBuffer vectors((2 * pairs + 1) * store.stride());
    std::vector<SweepTerm> terms;
    const auto vector = [&](std::size_t k) { return vectors.data() + k * store.stride(); };
    for (std::size_t k = 0; k <= 2 * pairs; ++k) {
      for (std::size_t i = 0; i < n; ++i) vector(k)[i] = value(engine);
    }
    for (std::size_t k = 0; k < pairs; ++k) {
      terms.push_back({vector(2 * k), vector(2 * k + 1), 1.0});
      terms.push_back({vector(2 * k + 1), vector(2 * k), 1.0});
    }
    terms.push_back({vector(2 * pairs), vector(2 * pairs), -1.0});
    sweep_upper(store.data(), store.stride(), n, terms);

    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i; j < n; ++j) {
        double expected = 0.0;
        for (const SweepTerm& term : terms) expected += term.sign * term.left[i] * term.right[j];
        ASSERT_NEAR(store.at(i, j), expected, 1e-12) << "n " << n << " at " << i << ", " << j;
      }
    }
  }
}

TEST(CovarianceSweep, SumsEveryElementInTheOrderOfTheTerms) {
  std::mt19937_64 engine(8);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  for (const std::size_t n : {5U, 319U, 320U, 321U, 645U}) {
    for (const std::size_t count : {1U, 4U, 7U, 10U}) {
      CovarianceStore store(n);
      AlignedBuffer vectors(count * store.stride());
      std::vector<SweepTerm> terms;
      for (std::size_t k = 0; k < count; ++k) {
        double* vector = vectors.data() + k * store.stride();
        for (std::size_t i = 0; i < n; ++i) vector[i] = value(engine);
        terms.push_back({vector, vector, k % 2 == 0 ? 1.0 : -1.0});
      }
      sweep_upper(store.data(), store.stride(), n, terms);
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = i; j < n; ++j) {
          double expected = 0.0;
          for (const SweepTerm& term : terms) {
            expected += (term.sign * term.left[i]) * term.right[j];
          }
          ASSERT_EQ(store.at(i, j), expected) << "n " << n << " at " << i << ", " << j;
        }
      }
    }
  }
}

TEST(CovarianceStore, ReadsTheUpperHalfFromBothSides) {
  CovarianceStore store(5);
  store.set(1, 4, 7.0);
  store.set(3, 2, 5.0);
  EXPECT_EQ(store.at(4, 1), 7.0);
  EXPECT_EQ(store.at(2, 3), 5.0);
  double column[5] = {};
  store.copy_column(3, 5, column);
  EXPECT_EQ(column[2], 5.0);
}

}  // namespace
}  // namespace roomwise::ekf
