#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "services/segment_svc/core/color/class_scores.h"
#include "services/segment_svc/core/color/color_grid.h"
#include "services/segment_svc/core/color/color_model.h"

namespace roomwise::segment {

/// Mean and spread of the grey levels of a class, from weighted samples.
class GreySums {
 public:
  void add(double grey_levels, double weight);
  void add(const GreySums& more);
  void fade(double ratio);
  double weight() const { return weight_; }
  /// Needs a weight above 0.
  GreyGaussian gaussian() const;

 private:
  double weight_ = 0.0;
  double first_ = 0.0;
  double second_ = 0.0;
};

/// Kullback-Leibler divergence of two Gaussians [nat].
double divergence(const GreyGaussian& from, const GreyGaussian& to);

/// What a pixel's colour says of its class: w ln p(colour | class), by histograms of 16 x 16 x 16
/// colours.
///
/// The histograms are learned on line, by expectation maximisation with forgetting (Cappe and
/// Moulines 2009): samples of each frame count for each class by how probable it is. What a person
/// taught outweighs what was seen. How far colour is believed,
///   w = clamp((L - 20) / 60) exp(-D / 2),  L the frame's mean grey level,
/// D the divergence of the classes' grey levels in this frame from what was seen before, is 0 in
/// the dark and small when the light has changed; what was taught is believed by the D of
/// the floor's grey levels from those taught.
class ColorEvidence {
 public:
  static constexpr std::size_t kBins = 16 * 16 * 16;
  static std::size_t bin(const std::uint8_t* rgb) {
    return static_cast<std::size_t>((rgb[0] >> 4U) << 8U | (rgb[1] >> 4U) << 4U | rgb[2] >> 4U);
  }

  void teach(const ColorModel& taught);

  /// A frame is begun, its samples added, and ended; from then on of() answers for it.
  void begin();
  /// `by_geometry`: probabilities of the classes without this pixel's colour; `all`: with it.
  void add(const std::uint8_t* rgb, const ClassScores& by_geometry, const ClassScores& all);
  void end();

  const ClassScores& of(std::size_t bin) const { return scores_[bin]; }
  /// of(bin)'s wall less its obstacle for each bin: small enough to stay in the first cache.
  const std::vector<float>& wall_lead() const { return wall_lead_; }
  /// Bins of the colours of a row of the depth image.
  static void bins_of_row(const ColorGrid& colors, std::size_t row, std::span<std::uint16_t> bins);
  /// w: 0 where colour says nothing.
  double reliability_ratio() const { return reliability_ratio_; }

 private:
  struct Taught {
    GreyClassifier::Gaussians grey;
    std::vector<ClassScores> histogram;  ///< kBins; each class adds up to 1
  };
  using ClassGreys = std::array<GreySums, kTrainedClasses.size()>;

  double divergence_from(const GreyClassifier::Gaussians& known) const;
  double reliability() const;
  double taught_share_ratio() const;
  void weigh();

  std::vector<ClassScores> seen_ = std::vector<ClassScores>(kBins);  ///< weights, forgotten slowly
  ClassScores seen_weight_{};
  ClassGreys seen_greys_;
  ClassGreys frame_greys_;
  GreySums frame_grey_;
  std::optional<Taught> taught_;
  std::vector<ClassScores> scores_ = std::vector<ClassScores>(kBins);
  std::vector<float> wall_lead_ = std::vector<float>(kBins);
  double reliability_ratio_ = 0.0;
  double taught_share_ratio_ = 0.0;
};

}  // namespace roomwise::segment
