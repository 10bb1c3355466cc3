#include "services/segment_svc/core/color/color_evidence.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numeric>

#include "tests/segment_svc/support/taught.h"

namespace roomwise::segment {
namespace {

using Rgb = std::array<std::uint8_t, 3>;
constexpr Rgb kBlue = {60, 60, 160};
constexpr Rgb kWhite = {200, 200, 190};
constexpr Rgb kBrown = {150, 110, 70};
constexpr ClassScores kSureObstacle = {0.98F, 0.01F, 0.01F};
constexpr ClassScores kSureWall = {0.01F, 0.98F, 0.01F};
constexpr ClassScores kSureFloor = {0.01F, 0.01F, 0.98F};

Rgb scaled(const Rgb& rgb, double ratio) {
  const auto level = [ratio](std::uint8_t value) {
    return static_cast<std::uint8_t>(std::lround(ratio * value));
  };
  return {level(rgb[0]), level(rgb[1]), level(rgb[2])};
}

/// A frame of equal parts of the three colours, in light of `light_ratio`.
void show_frame(ColorEvidence& evidence, double light_ratio = 1.0) {
  evidence.begin();
  for (int i = 0; i < 300; ++i) {
    evidence.add(scaled(kBlue, light_ratio).data(), kSureObstacle, kSureObstacle);
    evidence.add(scaled(kWhite, light_ratio).data(), kSureWall, kSureWall);
    evidence.add(scaled(kBrown, light_ratio).data(), kSureFloor, kSureFloor);
  }
  evidence.end();
}

void show_frames(ColorEvidence& evidence, int count, double light_ratio = 1.0) {
  for (int i = 0; i < count; ++i) show_frame(evidence, light_ratio);
}

ClassScores of(const ColorEvidence& evidence, const Rgb& rgb) {
  return evidence.of(ColorEvidence::bin(rgb.data()));
}

TEST(ColorEvidence, ColorsSeenOnAClassSpeakForIt) {
  ColorEvidence evidence;
  show_frames(evidence, 5);
  EXPECT_GT(of(evidence, kBlue)[0], of(evidence, kBlue)[1] + 2.0F);
  EXPECT_GT(of(evidence, kBlue)[0], of(evidence, kBlue)[2] + 2.0F);
  EXPECT_GT(of(evidence, kWhite)[1], of(evidence, kWhite)[0] + 2.0F);
  EXPECT_GT(of(evidence, kBrown)[2], of(evidence, kBrown)[1] + 2.0F);
}

TEST(ColorEvidence, ColorsNeverSeenSayLittle) {
  ColorEvidence evidence;
  show_frames(evidence, 5);
  const ClassScores strange = of(evidence, {10, 250, 10});
  EXPECT_NEAR(strange[0], strange[1], 0.1F);
  EXPECT_NEAR(strange[0], strange[2], 0.1F);
}

TEST(ColorEvidence, IsNotBelievedInTheDark) {
  ColorEvidence evidence;
  show_frames(evidence, 5, 0.05);
  EXPECT_EQ(evidence.reliability_ratio(), 0.0);
}

TEST(ColorEvidence, IsBelievedLessTheMoreTheLightHasChanged) {
  double before_ratio = 1.1;
  for (const double light_ratio : {1.0, 0.9, 0.8, 0.7, 0.6}) {
    ColorEvidence evidence;
    show_frames(evidence, 20);
    show_frame(evidence, light_ratio);
    EXPECT_LT(evidence.reliability_ratio(), before_ratio);
    before_ratio = evidence.reliability_ratio();
  }
  EXPECT_LT(before_ratio, 0.1);
}

TEST(ColorEvidence, LearnsNewLight) {
  ColorEvidence evidence;
  show_frames(evidence, 20);
  show_frames(evidence, 400, 0.8);
  EXPECT_GT(evidence.reliability_ratio(), 0.8);
  const ClassScores dimmed = of(evidence, scaled(kBrown, 0.8));
  EXPECT_GT(dimmed[2], dimmed[0] + 2.0F);
}

ColorModel taught() {
  const auto grey = [](const Rgb& rgb) {
    return GreyGaussian{.mean_levels = grey_level(rgb[0], rgb[1], rgb[2]) + 0.0,
                        .sigma_levels = 5.0};
  };
  const auto mixture = [](const Rgb& rgb) { return around(rgb[0], rgb[1], rgb[2]); };
  return {.grey = {grey(kBlue), grey(kWhite), grey(kBrown)},
          .mixtures = {mixture(kBlue), mixture(kWhite), mixture(kBrown)}};
}

/// What geometry alone makes of blue things that it takes for walls.
void show_mistaken_frame(ColorEvidence& evidence) {
  evidence.begin();
  for (int i = 0; i < 900; ++i) {
    evidence.add(kBlue.data(), kSureWall, kSureWall);
    evidence.add(kBrown.data(), kSureFloor, kSureFloor);
  }
  evidence.end();
}

TEST(ColorEvidence, WhatWasTaughtSpeaksBesideWhatWasSeen) {
  ColorEvidence untaught;
  show_mistaken_frame(untaught);
  const float before = of(untaught, kBlue)[0] - of(untaught, kBlue)[1];

  ColorEvidence evidence;
  evidence.teach(taught());
  show_mistaken_frame(evidence);
  EXPECT_GT(of(evidence, kBlue)[0] - of(evidence, kBlue)[1], before + 1.0F);
}

TEST(ColorEvidence, WhatWasTaughtInOtherLightIsLeftAside) {
  ColorModel model = taught();
  for (GreyGaussian& grey : model.grey) grey.mean_levels *= 0.5;
  ColorEvidence evidence;
  evidence.teach(model);
  ColorEvidence untaught;
  show_frames(evidence, 3);
  show_frames(untaught, 3);
  for (const Rgb& rgb : {kBlue, kWhite, kBrown}) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(of(evidence, rgb)[k], of(untaught, rgb)[k], 0.05F);
    }
  }
}

RC_GTEST_PROP(ColorEvidence, StaysFiniteWhateverIsShown, ()) {
  ColorEvidence evidence;
  if (*rc::gen::arbitrary<bool>()) evidence.teach(taught());
  for (int frame = 0; frame < 3; ++frame) {
    evidence.begin();
    const int samples = *rc::gen::inRange(0, 50);
    for (int i = 0; i < samples; ++i) {
      const auto rgb = *rc::gen::arbitrary<Rgb>();
      const ClassScores p = normalised({static_cast<float>(*rc::gen::inRange(-200, 200)),
                                        static_cast<float>(*rc::gen::inRange(-200, 200)), 0.0F});
      evidence.add(rgb.data(), p, p);
    }
    evidence.end();
    RC_ASSERT(evidence.reliability_ratio() >= 0.0 && evidence.reliability_ratio() <= 1.0);
    for (std::size_t bin = 0; bin < ColorEvidence::kBins; ++bin) {
      for (const float score : evidence.of(bin)) RC_ASSERT(std::isfinite(score));
    }
  }
}

RC_GTEST_PROP(Divergence, IsZeroOnlyFromItself, ()) {
  const auto gaussian = [] {
    return GreyGaussian{.mean_levels = *rc::gen::inRange(0, 256) + 0.0,
                        .sigma_levels = *rc::gen::inRange(1, 100) + 0.0};
  };
  const GreyGaussian a = gaussian();
  const GreyGaussian b = gaussian();
  RC_ASSERT(divergence(a, a) == 0.0);
  RC_ASSERT(divergence(a, b) >= -1e-12);
}

RC_GTEST_PROP(ClassScores, ProbabilitiesAddUpToOne, ()) {
  ClassScores logarithms{};
  for (float& value : logarithms) value = static_cast<float>(*rc::gen::inRange(-300, 300));
  const ClassScores p = normalised(logarithms);
  RC_ASSERT(std::abs(std::accumulate(p.begin(), p.end(), 0.0F) - 1.0F) < 1e-5F);
}

}  // namespace
}  // namespace roomwise::segment
