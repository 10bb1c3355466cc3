#include "services/segment_svc/core/color/color_evidence.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "common/multiversion.h"

namespace roomwise::segment {
namespace {

constexpr std::size_t kFloorIndex = 2;
constexpr float kBinCount = static_cast<float>(ColorEvidence::kBins);

constexpr double kForgetting_ratio = 0.995;  ///< a frame: half is forgotten in five seconds
constexpr double kDark_levels = 20.0;
constexpr double kBright_levels = 80.0;

/// Colours never seen say nothing: each is given this share of a class.
constexpr float kUnseen_ratio = 0.02F;
/// As if so many samples of every colour alike had been seen: a few first ones decide nothing.
constexpr float kFirst_weight = 200.0F;
/// What was taught counts nine times what was seen, in the light it was taught in; colours that
/// were not taught are left to what was seen.
constexpr double kTaught_ratio = 0.9;
/// A class of less weight in a frame does not tell what the light is like.
constexpr double kWeightMin = 20.0;

/// p(colour | class) on the grid of bins: densities of the logarithms, times 1 / (r g b) for the
/// change to levels, summed over eight places in each bin.
std::vector<ClassScores> histogram_of(const ClassMixtures& mixtures) {
  constexpr std::size_t kFine = 32;
  std::vector<ClassScores> histogram(ColorEvidence::kBins);
  ClassScores sum{};
  for (std::size_t i = 0; i < kFine * kFine * kFine; ++i) {
    const auto level = [](std::size_t step) { return static_cast<std::uint8_t>(8 * step + 4); };
    const std::array<std::uint8_t, 3> rgb = {level(i / (kFine * kFine)), level(i / kFine % kFine),
                                             level(i % kFine)};
    const ColorFeature x = color_feature(rgb[0], rgb[1], rgb[2]);
    const double volume = 1.0 / ((rgb[0] + 1.0) * (rgb[1] + 1.0) * (rgb[2] + 1.0));
    for (std::size_t k = 0; k < kTrainedClassCount; ++k) {
      const auto share = static_cast<float>(std::exp(mixtures[k].log_likelihood(x)) * volume);
      histogram[ColorEvidence::bin(rgb.data())][k] += share;
      sum[k] += share;
    }
  }
  for (ClassScores& bin : histogram) {
    for (std::size_t k = 0; k < kTrainedClassCount; ++k) {
      bin[k] = sum[k] > 0.0F ? bin[k] / sum[k] : 1.0F / kBinCount;
    }
  }
  return histogram;
}

/// Natural logarithm of positive numbers in place, to a float's last digits: with x = 2^e m and m
/// between sqrt(1/2) and sqrt(2), e ln 2 + 2 artanh((m - 1) / (m + 1)).
ROOMWISE_MULTIVERSION
void take_logarithms(float* x, std::size_t count) {
  constexpr std::int32_t kRootOfHalf = 0x3f3504f3;  // its bits
  constexpr int kMantissaBits = 23;
  for (std::size_t i = 0; i < count; ++i) {
    const auto bits = std::bit_cast<std::int32_t>(x[i]);
    const std::int32_t e = (bits - kRootOfHalf) >> kMantissaBits;
    const float m = std::bit_cast<float>(bits - e * (1 << kMantissaBits));
    const float s = (m - 1.0F) / (m + 1.0F);
    const float s2 = s * s;
    const float series = s2 * (1.0F / 3 + s2 * (1.0F / 5 + s2 * (1.0F / 7 + s2 / 9.0F)));
    x[i] = static_cast<float>(e) * std::numbers::ln2_v<float> + 2.0F * (s + s * series);
  }
}

/// For colour pixels side by side.
ROOMWISE_MULTIVERSION
void bins_of(const std::uint8_t* rgb, std::size_t count, std::uint16_t* __restrict bins) {
  for (std::size_t i = 0; i < count; ++i) {
    bins[i] = static_cast<std::uint16_t>(ColorEvidence::bin(rgb + 3 * i));
  }
}

}  // namespace

void ColorEvidence::bins_of_row(const ColorGrid& colors, std::size_t row,
                                std::span<std::uint16_t> bins) {
  const std::uint8_t* rgb = colors.row(row);
  if (colors.is_one_to_one()) return bins_of(rgb, bins.size(), bins.data());
  for (std::size_t u = 0; u < bins.size(); ++u) {
    bins[u] = static_cast<std::uint16_t>(bin(colors.at(rgb, u)));
  }
}

void GreySums::add(double grey_levels, double weight) {
  weight_ += weight;
  first_ += weight * grey_levels;
  second_ += weight * grey_levels * grey_levels;
}

void GreySums::add(const GreySums& more) {
  weight_ += more.weight_;
  first_ += more.first_;
  second_ += more.second_;
}

void GreySums::fade(double ratio) {
  weight_ *= ratio;
  first_ *= ratio;
  second_ *= ratio;
}

GreyGaussian GreySums::gaussian() const {
  const double mean_levels = first_ / weight_;
  const double variance = std::max(second_ / weight_ - mean_levels * mean_levels, 0.0);
  return {.mean_levels = mean_levels, .sigma_levels = std::max(std::sqrt(variance), 1.0)};
}

double divergence(const GreyGaussian& from, const GreyGaussian& to) {
  const double ratio = from.sigma_levels / to.sigma_levels;
  const double shift = (from.mean_levels - to.mean_levels) / to.sigma_levels;
  return 0.5 * (ratio * ratio + shift * shift - 1.0) - std::log(ratio);
}

void ColorEvidence::teach(const ColorModel& taught) {
  taught_ = {.grey = taught.grey, .histogram = histogram_of(taught.mixtures)};
}

void ColorEvidence::begin() {
  constexpr auto kKept = static_cast<float>(kForgetting_ratio);
  for (ClassScores& bin : seen_) {
    for (float& weight : bin) weight *= kKept;
  }
  for (float& weight : seen_weight_) weight *= kKept;
  frame_greys_ = {};
  frame_grey_ = {};
}

void ColorEvidence::add(const std::uint8_t* rgb, const ClassScores& by_geometry,
                        const ClassScores& all) {
  const std::uint8_t grey = grey_level(rgb[0], rgb[1], rgb[2]);
  frame_grey_.add(grey, 1.0);
  ClassScores& seen = seen_[bin(rgb)];
  for (std::size_t k = 0; k < kTrainedClassCount; ++k) {
    frame_greys_[k].add(grey, static_cast<double>(by_geometry[k]));
    seen[k] += all[k];
    seen_weight_[k] += all[k];
  }
}

/// Mean over the frame's classes, by their weight.
double ColorEvidence::divergence_from(const GreyClassifier::Gaussians& known) const {
  double sum = 0.0;
  double weight = 0.0;
  for (std::size_t k = 0; k < kTrainedClassCount; ++k) {
    if (frame_greys_[k].weight() < kWeightMin) continue;
    sum += frame_greys_[k].weight() * divergence(frame_greys_[k].gaussian(), known[k]);
    weight += frame_greys_[k].weight();
  }
  return weight > 0.0 ? sum / weight : 0.0;
}

double ColorEvidence::reliability() const {
  if (frame_grey_.weight() == 0.0) return 0.0;
  const double brightness_ratio = std::clamp(
      (frame_grey_.gaussian().mean_levels - kDark_levels) / (kBright_levels - kDark_levels), 0.0,
      1.0);
  GreyClassifier::Gaussians seen;
  for (std::size_t k = 0; k < kTrainedClassCount; ++k) {
    // What was not seen before differs from nothing.
    const GreySums& sums = seen_greys_[k].weight() > 0.0 ? seen_greys_[k] : frame_greys_[k];
    if (sums.weight() > 0.0) seen[k] = sums.gaussian();
  }
  return brightness_ratio * std::exp(-0.5 * divergence_from(seen));
}

/// Floor is what geometry is surest of, so its grey tells the light; whether the other classes look
/// as taught tells more of geometry.
double ColorEvidence::taught_share_ratio() const {
  if (!taught_) return 0.0;
  const GreySums& floor = frame_greys_[kFloorIndex];
  if (floor.weight() < kWeightMin) return taught_share_ratio_;
  return kTaught_ratio * std::exp(-0.5 * divergence(floor.gaussian(), taught_->grey[kFloorIndex]));
}

void ColorEvidence::end() {
  reliability_ratio_ = reliability();
  for (std::size_t k = 0; k < kTrainedClassCount; ++k) {
    seen_greys_[k].fade(kForgetting_ratio);
    seen_greys_[k].add(frame_greys_[k]);
  }
  taught_share_ratio_ = taught_share_ratio();
  if (reliability_ratio_ > 0.0) weigh();
}

void ColorEvidence::weigh() {
  const auto w = static_cast<float>(reliability_ratio_);
  const auto taught_share = static_cast<float>(taught_share_ratio_);
  for (std::size_t i = 0; i < kBins; ++i) {
    for (std::size_t k = 0; k < kTrainedClassCount; ++k) {
      float p = (seen_[i][k] + kFirst_weight / kBinCount) / (seen_weight_[k] + kFirst_weight);
      if (taught_share > 0.0F) p += taught_share * (taught_->histogram[i][k] - p);
      scores_[i][k] = (1.0F - kUnseen_ratio) * p + kUnseen_ratio / kBinCount;
    }
  }
  take_logarithms(scores_.front().data(), kBins * kTrainedClassCount);
  for (std::size_t i = 0; i < kBins; ++i) {
    for (float& score : scores_[i]) score *= w;
    wall_lead_[i] = scores_[i][1] - scores_[i][0];
  }
}

}  // namespace roomwise::segment
