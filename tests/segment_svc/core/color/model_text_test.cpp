#include "services/segment_svc/core/color/model_text.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <zlib.h>

#include <array>
#include <cstdio>
#include <vector>

namespace roomwise::segment {
namespace {

ColorModel taught() {
  const auto mixture = [](double red) {
    return Mixture({{.weight_ratio = 0.75, .mean = {red, -0.25, 3.5}},
                    {.weight_ratio = 0.25,
                     .mean = {0.0, 0.125, 4.5},
                     .covariance = Eigen::Vector3d(0.5, 0.25, 2.0).asDiagonal()}});
  };
  return {.grey = {{{11.11107, 22.556}, {108.2956, 61.398}, {71.314, 51.575}}},
          .mixtures = {mixture(0.5), mixture(1.5), mixture(2.5)}};
}

/// The text with a right CRC, whatever it says.
std::string sealed(const std::string& lines) {
  const auto* bytes = reinterpret_cast<const Bytef*>(lines.data());
  std::array<char, 16> crc{};
  std::snprintf(crc.data(), crc.size(), "crc32 %08lx\n",
                ::crc32(0, bytes, static_cast<uInt>(lines.size())));
  return lines + crc.data();
}

std::string lines_of(const std::string& text) { return text.substr(0, text.rfind("crc32 ")); }

std::string with(std::string text, std::string_view what, std::string_view instead) {
  return text.replace(text.find(what), what.size(), instead);
}

void expect_fault(const std::string& text, ModelFault fault) {
  const auto model = parse_model(text);
  ASSERT_TRUE(std::holds_alternative<ModelFault>(model)) << text;
  EXPECT_EQ(std::get<ModelFault>(model), fault) << text;
}

double any_between(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1000001) / 1e6;
}

RC_GTEST_PROP(ModelText, ReadsBackExactly, ()) {
  ColorModel model = taught();
  for (GreyGaussian& gaussian : model.grey) {
    gaussian = {.mean_levels = any_between(0.0, 255.0), .sigma_levels = any_between(0.3, 255.0)};
  }
  std::vector<MixturePart> parts(*rc::gen::inRange<std::size_t>(1, kMixturePartsMax + 1));
  for (MixturePart& part : parts) {
    part.weight_ratio = any_between(0.01, 1.0);
    part.mean = {any_between(-3, 3), any_between(-3, 3), any_between(0, 5.5)};
    const Eigen::Vector3d side(any_between(-1, 1), any_between(-1, 1), any_between(-1, 1));
    part.covariance = 0.01 * Eigen::Matrix3d::Identity() + side * side.transpose();
  }
  model.mixtures[1] = Mixture(parts);
  const auto back = parse_model(format_model(model));
  RC_ASSERT(std::holds_alternative<ColorModel>(back));
  const ColorModel& read = std::get<ColorModel>(back);
  for (std::size_t k = 0; k < model.grey.size(); ++k) {
    RC_ASSERT(read.grey[k].mean_levels == model.grey[k].mean_levels);
    RC_ASSERT(read.grey[k].sigma_levels == model.grey[k].sigma_levels);
  }
  RC_ASSERT(read.mixtures[1].parts().size() == parts.size());
  for (std::size_t k = 0; k < parts.size(); ++k) {
    RC_ASSERT(read.mixtures[1].parts()[k].mean == parts[k].mean);
    RC_ASSERT(read.mixtures[1].parts()[k].covariance == parts[k].covariance);
  }
}

TEST(ModelText, IsWhatTheHeaderShows) {
  EXPECT_TRUE(
      format_model(taught()).starts_with("roomwise-segment-model 2\n"
                                         "class 0 mean_levels 11.11107 sigma_levels 22.556\n"
                                         "part 0.75 0.5 -0.25 3.5 1 0 1 0 0 1\n"
                                         "part 0.25 0 0.125 4.5 0.5 0 0.25 0 0 2\n"
                                         "class 100 mean_levels 108.2956 sigma_levels 61.398\n"))
      << format_model(taught());
}

TEST(ModelText, EveryCutIsRefused) {
  const std::string text = format_model(taught());
  for (std::size_t length = 0; length < text.size(); ++length) {
    EXPECT_TRUE(std::holds_alternative<ModelFault>(parse_model(text.substr(0, length)))) << length;
  }
}

TEST(ModelText, EveryFlippedBitIsRefused) {
  const std::string text = format_model(taught());
  for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
    std::string damaged = text;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_TRUE(std::holds_alternative<ModelFault>(parse_model(damaged))) << bit;
  }
}

TEST(ModelText, SaysWhyItRefuses) {
  const std::string lines = lines_of(format_model(taught()));
  expect_fault("", ModelFault::kForeign);
  expect_fault("model = \"gaussian\"\n", ModelFault::kForeign);
  expect_fault(sealed(with(lines, "model 2", "model 1 gaussian")), ModelFault::kVersion);
  expect_fault(lines, ModelFault::kCut);
  expect_fault(with(format_model(taught()), "11.11107", "12.11107"), ModelFault::kDamaged);
  expect_fault(format_model(taught()) + "\n", ModelFault::kDamaged);
  for (const auto& [what, instead] : {std::pair{"11.11107", "nan"},
                                      {"11.11107", "-1"},
                                      {"11.11107", "256"},
                                      {"22.556", "0"},
                                      {"22.556", "inf"},
                                      {"22.556", "22.556 7"},
                                      {"class 100", "class 50"},
                                      {"mean_levels", "mean_m"},
                                      {"class 200 mean_levels 71.314 sigma_levels 51.575\n", ""},
                                      {"part 0.75", "part 0"},
                                      {"part 0.75", "part nan"},
                                      {"part 0.75", "part 1.5"},
                                      {"part 0.75", "bit 0.75"},
                                      {" 4.5 ", " inf "},
                                      {" 4.5 ", " 1e9 "},
                                      {"0.5 0 0.25 0 0 2", "0.5 0 0.25 0 0 -2"},
                                      {"0.5 0 0.25 0 0 2", "0.5 1 0.25 0 0 2"},
                                      {"0.5 0 0.25 0 0 2", "0.5 0 0.25 0 0"},
                                      {"0.5 0 0.25 0 0 2", "0.5 0 0.25 0 0 2 0"}}) {
    expect_fault(sealed(with(lines, what, instead)), ModelFault::kValues);
  }
}

TEST(ModelText, ClassOfTooManyPartsOrNoneIsRefused) {
  const std::string lines = lines_of(format_model(taught()));
  const std::string part = "part 0.25 0 0.125 4.5 0.5 0 0.25 0 0 2\n";
  EXPECT_FALSE(std::holds_alternative<ModelFault>(
      parse_model(sealed(with(lines, part, part + part + part + part)))));
  expect_fault(sealed(with(lines, part, part + part + part + part + part)), ModelFault::kValues);
  ColorModel one_part = taught();
  one_part.mixtures[0] = Mixture(std::vector<MixturePart>(1));
  const std::string only = "part 1 0 0 0 1 0 1 0 0 1\n";
  expect_fault(sealed(with(lines_of(format_model(one_part)), only, "")), ModelFault::kValues);
}

RC_GTEST_PROP(ModelText, ArbitraryTextIsRefused, (const std::string& text)) {
  RC_ASSERT(std::holds_alternative<ModelFault>(parse_model(text)));
}

}  // namespace
}  // namespace roomwise::segment
