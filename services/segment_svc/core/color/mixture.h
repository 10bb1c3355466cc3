#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace roomwise::segment {

/// What the colour of a pixel is told by: log(R/G), log(B/G) and log luma, each level plus one.
using ColorFeature = Eigen::Vector3d;
ColorFeature color_feature(std::uint8_t red, std::uint8_t green, std::uint8_t blue);

/// One Gaussian of a mixture, full covariance.
struct MixturePart {
  double weight_ratio = 1.0;  ///< of all parts together 1
  ColorFeature mean = ColorFeature::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
};

/// A mixture of Gaussians over colour features.
class Mixture {
 public:
  explicit Mixture(std::vector<MixturePart> parts);

  const std::vector<MixturePart>& parts() const { return parts_; }

  /// ln sum_k w_k N(x; mean_k, covariance_k), summed without underflow (log-sum-exp).
  double log_likelihood(const ColorFeature& x) const;
  /// The same; fills in each part's share of it, which add up to 1. One entry of `shares` a part.
  double log_likelihood(const ColorFeature& x, std::span<double> shares) const;
  /// ln(w_k N(x; mean_k, covariance_k)).
  double log_share(std::size_t k, const ColorFeature& x) const;

 private:
  struct Prepared {
    Eigen::Matrix3d whitening;  ///< inverse of the covariance's Cholesky factor
    double log_scale = 0.0;
  };
  std::vector<MixturePart> parts_;
  std::vector<Prepared> prepared_;
};

struct MixtureFit {
  int iterations_max = 100;
  double gain_min = 1e-6;      ///< of the mean log-likelihood; less ends the iteration
  double variance_min = 1e-4;  ///< added to each variance: levels are whole numbers
  std::uint32_t seed = 1;      ///< of k-means++
};

/// Expectation maximisation from k-means++ centres (Arthur and Vassilvitskii 2007):
/// responsibilities r_ik = w_k N_k(x_i) / sum_j w_j N_j(x_i), then weights, means and covariances
/// by them (Dempster, Laird and Rubin 1977). Nothing if there are fewer than 10 samples a part.
/// Same input, same bits.
std::optional<Mixture> fit_mixture(std::span<const ColorFeature> samples, int parts,
                                   const MixtureFit& fit = {});

/// Mean log-likelihood of the samples.
double mean_log_likelihood(const Mixture& mixture, std::span<const ColorFeature> samples);

/// The mixture of 1 to `parts_max` parts with the least Bayesian information criterion,
/// p ln N - 2 ln L with p = 10 K - 1 parameters (Schwarz 1978).
std::optional<Mixture> fit_best_mixture(std::span<const ColorFeature> samples, int parts_max,
                                        const MixtureFit& fit = {});

}  // namespace roomwise::segment
