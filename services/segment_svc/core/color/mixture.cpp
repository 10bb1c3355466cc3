#include "services/segment_svc/core/color/mixture.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>
#include <utility>

namespace roomwise::segment {
namespace {

constexpr std::size_t kSamplesMin = 10;  // a part
constexpr double kParametersPerPart = 10.0;

/// In [0, 1), the same on every machine: std::uniform_real_distribution is not.
double uniform(std::mt19937& random) { return static_cast<double>(random()) * 0x1p-32; }

/// Centres far apart: each next one drawn with a chance that grows as its distance squared.
std::vector<ColorFeature> spread_centers(std::span<const ColorFeature> samples, std::size_t count,
                                         std::mt19937& random) {
  const auto first =
      static_cast<std::size_t>(uniform(random) * static_cast<double>(samples.size()));
  std::vector<ColorFeature> centers(1, samples[first]);
  std::vector<double> distance(samples.size(), std::numeric_limits<double>::infinity());
  while (centers.size() < count) {
    double total = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      distance[i] = std::min(distance[i], (samples[i] - centers.back()).squaredNorm());
      total += distance[i];
    }
    double rest = uniform(random) * total;
    std::size_t chosen = 0;
    while (chosen + 1 < samples.size() && rest >= distance[chosen]) rest -= distance[chosen++];
    centers.push_back(samples[chosen]);
  }
  return centers;
}

/// Sums from which a part's weight, mean and covariance follow.
struct PartSums {
  double weight = 0.0;
  ColorFeature first = ColorFeature::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

  void add(const ColorFeature& x, double share) {
    weight += share;
    first += share * x;
    second += share * x * x.transpose();
  }
};

std::vector<MixturePart> parts_of(const std::vector<PartSums>& sums, std::size_t samples,
                                  double variance_min) {
  std::vector<MixturePart> parts;
  for (const PartSums& sum : sums) {
    const double weight = std::max(sum.weight, 1e-9);
    MixturePart& part = parts.emplace_back();
    part.weight_ratio = weight / static_cast<double>(samples);
    part.mean = sum.first / weight;
    part.covariance = sum.second / weight - part.mean * part.mean.transpose() +
                      variance_min * Eigen::Matrix3d::Identity();
  }
  return parts;
}

std::vector<MixturePart> first_guess(std::span<const ColorFeature> samples,
                                     const std::vector<ColorFeature>& centers,
                                     double variance_min) {
  std::vector<PartSums> sums(centers.size());
  for (const ColorFeature& x : samples) {
    const auto nearest = std::min_element(centers.begin(), centers.end(), [&](auto& a, auto& b) {
      return (a - x).squaredNorm() < (b - x).squaredNorm();
    });
    sums[static_cast<std::size_t>(nearest - centers.begin())].add(x, 1.0);
  }
  return parts_of(sums, samples.size(), variance_min);
}

/// One round of EM; the mean log-likelihood of the mixture it began with.
std::pair<Mixture, double> improve(const Mixture& mixture, std::span<const ColorFeature> samples,
                                   double variance_min) {
  std::vector<PartSums> sums(mixture.parts().size());
  std::vector<double> shares(sums.size());
  double log_likelihood = 0.0;
  for (const ColorFeature& x : samples) {
    log_likelihood += mixture.log_likelihood(x, shares);
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k].add(x, shares[k]);
  }
  return {Mixture(parts_of(sums, samples.size(), variance_min)),
          log_likelihood / static_cast<double>(samples.size())};
}

}  // namespace

ColorFeature color_feature(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
  const double r = red + 1.0;
  const double g = green + 1.0;
  const double b = blue + 1.0;
  return {std::log(r / g), std::log(b / g), std::log(0.299 * r + 0.587 * g + 0.114 * b)};
}

Mixture::Mixture(std::vector<MixturePart> parts) : parts_(std::move(parts)) {
  if (parts_.empty()) throw std::invalid_argument("mixture of no parts");
  for (const MixturePart& part : parts_) {
    const Eigen::LLT<Eigen::Matrix3d> factor(part.covariance);
    if (factor.info() != Eigen::Success || !(part.weight_ratio > 0.0)) {
      throw std::invalid_argument("mixture: a part is no Gaussian");
    }
    const Eigen::Matrix3d L = factor.matrixL();
    prepared_.push_back({.whitening = L.inverse(),
                         .log_scale = std::log(part.weight_ratio) -
                                      1.5 * std::log(2.0 * std::numbers::pi) -
                                      L.diagonal().array().log().sum()});
  }
}

double Mixture::log_share(std::size_t k, const ColorFeature& x) const {
  return prepared_[k].log_scale -
         0.5 * (prepared_[k].whitening * (x - parts_[k].mean)).squaredNorm();
}

double Mixture::log_likelihood(const ColorFeature& x) const {
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < parts_.size(); ++k) largest = std::max(largest, log_share(k, x));
  double sum = 0.0;
  for (std::size_t k = 0; k < parts_.size(); ++k) sum += std::exp(log_share(k, x) - largest);
  return largest + std::log(sum);
}

double Mixture::log_likelihood(const ColorFeature& x, std::span<double> shares) const {
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < shares.size(); ++k) {
    shares[k] = log_share(k, x);
    largest = std::max(largest, shares[k]);
  }
  double sum = 0.0;
  for (double& share : shares) sum += share = std::exp(share - largest);
  for (double& share : shares) share /= sum;
  return largest + std::log(sum);
}

double mean_log_likelihood(const Mixture& mixture, std::span<const ColorFeature> samples) {
  double sum = 0.0;
  for (const ColorFeature& x : samples) sum += mixture.log_likelihood(x);
  return sum / static_cast<double>(samples.size());
}

std::optional<Mixture> fit_mixture(std::span<const ColorFeature> samples, int parts,
                                   const MixtureFit& fit) {
  if (parts < 1 || samples.size() < kSamplesMin * static_cast<std::size_t>(parts)) {
    return std::nullopt;
  }
  std::mt19937 random(fit.seed);
  const auto centers = spread_centers(samples, static_cast<std::size_t>(parts), random);
  Mixture mixture(first_guess(samples, centers, fit.variance_min));
  double before = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < fit.iterations_max; ++i) {
    auto [better, log_likelihood] = improve(mixture, samples, fit.variance_min);
    if (log_likelihood - before < fit.gain_min) break;
    before = log_likelihood;
    mixture = std::move(better);
  }
  return mixture;
}

std::optional<Mixture> fit_best_mixture(std::span<const ColorFeature> samples, int parts_max,
                                        const MixtureFit& fit) {
  std::optional<Mixture> best;
  double best_bic = std::numeric_limits<double>::infinity();
  const auto count = static_cast<double>(samples.size());
  for (int parts = 1; parts <= parts_max; ++parts) {
    std::optional<Mixture> mixture = fit_mixture(samples, parts, fit);
    if (!mixture) break;
    const double bic = (kParametersPerPart * parts - 1.0) * std::log(count) -
                       2.0 * count * mean_log_likelihood(*mixture, samples);
    if (bic < best_bic) {
      best_bic = bic;
      best = std::move(mixture);
    }
  }
  return best;
}

}  // namespace roomwise::segment
