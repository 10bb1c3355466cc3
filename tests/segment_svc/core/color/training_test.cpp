#include "services/segment_svc/core/color/training.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "services/segment_svc/core/labels.h"

namespace roomwise::segment {
namespace {

/// Three stripes of 20 columns: dark, middle, bright, each of two levels.
ColorImage stripes() {
  ColorImage color{.width_px = 60, .height_px = 40, .rgb = {}};
  for (int v = 0; v < color.height_px; ++v) {
    for (int u = 0; u < color.width_px; ++u) {
      const int level = 40 + 80 * (u / 20) + 4 * (v % 2);
      color.rgb.insert(color.rgb.end(), 3, static_cast<std::uint8_t>(level));
    }
  }
  return color;
}

const TrainingRectangle kDark{kObstacle, 0, 0, 20, 40};
const TrainingRectangle kMiddle{kWall, 20, 0, 20, 40};
const TrainingRectangle kBright{kAccessible, 40, 0, 20, 40};

std::variant<ColorModel, TrainingFault> learn(const std::vector<TrainingRectangle>& rectangles) {
  return train(stripes(), rectangles, GreyStatistics::kAverage);
}

void expect_fault(const std::vector<TrainingRectangle>& rectangles, TrainingFault fault) {
  const auto learned = learn(rectangles);
  ASSERT_TRUE(std::holds_alternative<TrainingFault>(learned)) << name_of(fault);
  EXPECT_STREQ(name_of(std::get<TrainingFault>(learned)), name_of(fault));
}

TEST(Training, LearnsEachClassFromItsRectangles) {
  const auto learned = learn({kBright, kDark, kMiddle});
  const auto& gaussians = std::get<ColorModel>(learned).grey;
  EXPECT_DOUBLE_EQ(gaussians[0].mean_levels, 42.0);
  EXPECT_DOUBLE_EQ(gaussians[1].mean_levels, 122.0);
  EXPECT_DOUBLE_EQ(gaussians[2].mean_levels, 202.0);
  EXPECT_DOUBLE_EQ(gaussians[2].sigma_levels, 2.0);
}

TEST(Training, LearnsAMixtureWhereAClassHasSeveralColours) {
  const auto learned = learn({kDark, {kAccessible, 20, 0, 40, 40}, {kWall, 10, 0, 20, 40}});
  const auto& mixtures = std::get<ColorModel>(learned).mixtures;
  ASSERT_GE(mixtures[2].parts().size(), 2U);
  EXPECT_GT(mixtures[2].log_likelihood(color_feature(122, 122, 122)),
            mixtures[2].log_likelihood(color_feature(160, 160, 160)));
}

TEST(Training, SeveralRectanglesOfAClassCountTogether) {
  const auto learned =
      learn({{kObstacle, 0, 0, 10, 40}, kMiddle, kBright, {kObstacle, 10, 0, 10, 40}});
  EXPECT_DOUBLE_EQ(std::get<ColorModel>(learned).grey[0].mean_levels, 42.0);
}

TEST(Training, NamesWhatIsWrong) {
  constexpr int kMax = std::numeric_limits<int>::max();
  constexpr int kMin = std::numeric_limits<int>::min();
  expect_fault({}, TrainingFault::kClassMissing);
  expect_fault({kDark, kBright}, TrainingFault::kClassMissing);
  for (const TrainingRectangle& outside : {TrainingRectangle{kWall, 41, 0, 20, 40},
                                           {kWall, -1, 0, 20, 40},
                                           {kWall, 0, 1, 20, 40},
                                           {kWall, 0, -1, 5, 5},
                                           {kWall, 0, 0, 0, 5},
                                           {kWall, 0, 0, 5, -5},
                                           {kWall, kMax, 0, kMax, 1},
                                           {kWall, 0, kMax, 1, kMax},
                                           {kWall, kMin, kMin, kMax, kMax}}) {
    expect_fault({kDark, outside, kBright}, TrainingFault::kOutsideImage);
  }
  expect_fault({kDark, {7, 0, 0, 5, 5}, kBright}, TrainingFault::kUnknownLabel);
  expect_fault({kDark, {kUnknown, 0, 0, 5, 5}, kBright}, TrainingFault::kUnknownLabel);
  expect_fault({kDark, {kWall, 25, 3, 1, 1}, kBright}, TrainingFault::kTooFewPixels);
  expect_fault({kDark, {kWall, 0, 0, 20, 40}, kBright}, TrainingFault::kClassesAlike);
  EXPECT_EQ(std::get<TrainingFault>(train(ColorImage{}, std::vector{kDark, kMiddle, kBright},
                                          GreyStatistics::kAverage)),
            TrainingFault::kNoColor);
}

}  // namespace
}  // namespace roomwise::segment
