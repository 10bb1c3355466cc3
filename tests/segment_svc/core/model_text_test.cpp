#include "services/segment_svc/core/model_text.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <zlib.h>

namespace roomwise::segment {
namespace {

const GreyClassifier::Gaussians kModel = {
    {{11.11107, 22.556}, {108.2956, 61.398}, {71.314, 51.575}}};

/// The text with a right CRC, whatever it says.
std::string sealed(const std::string& lines) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  const std::uint32_t crc = crc32_of(lines);
  std::string hex;
  for (int shift = 28; shift >= 0; shift -= 4)
    hex += kDigits[crc >> static_cast<unsigned>(shift) & 15U];
  return lines + "crc32 " + hex + "\n";
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

RC_GTEST_PROP(ModelText, ReadsBackExactly, ()) {
  GreyClassifier::Gaussians model;
  for (GreyGaussian& gaussian : model) {
    gaussian.mean_levels = 255.0 * *rc::gen::inRange(0, 1000001) / 1e6;
    gaussian.sigma_levels = 0.3 + 254.0 * *rc::gen::inRange(0, 1000001) / 1e6;
  }
  const auto back = parse_model(format_model(model));
  RC_ASSERT(std::holds_alternative<GreyClassifier::Gaussians>(back));
  for (std::size_t k = 0; k < model.size(); ++k) {
    const GreyGaussian& read = std::get<GreyClassifier::Gaussians>(back)[k];
    RC_ASSERT(read.mean_levels == model[k].mean_levels);
    RC_ASSERT(read.sigma_levels == model[k].sigma_levels);
  }
}

TEST(ModelText, IsWhatTheHeaderShows) {
  EXPECT_EQ(lines_of(format_model(kModel)),
            "roomwise-segment-model 1 gaussian\n"
            "class 0 mean_levels 11.11107 sigma_levels 22.556\n"
            "class 100 mean_levels 108.2956 sigma_levels 61.398\n"
            "class 200 mean_levels 71.314 sigma_levels 51.575\n");
}

TEST(ModelText, EveryCutIsRefused) {
  const std::string text = format_model(kModel);
  for (std::size_t length = 0; length < text.size(); ++length) {
    EXPECT_TRUE(std::holds_alternative<ModelFault>(parse_model(text.substr(0, length)))) << length;
  }
}

TEST(ModelText, EveryFlippedBitIsRefused) {
  const std::string text = format_model(kModel);
  for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
    std::string damaged = text;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_TRUE(std::holds_alternative<ModelFault>(parse_model(damaged))) << bit;
  }
}

TEST(ModelText, SaysWhyItRefuses) {
  const std::string lines = lines_of(format_model(kModel));
  expect_fault("", ModelFault::kForeign);
  expect_fault("model = \"gaussian\"\n", ModelFault::kForeign);
  expect_fault(sealed(with(lines, "model 1", "model 2")), ModelFault::kVersion);
  expect_fault(sealed(with(lines, "gaussian", "mixture")), ModelFault::kVersion);
  expect_fault(lines, ModelFault::kCut);
  expect_fault(with(format_model(kModel), "11.11107", "12.11107"), ModelFault::kDamaged);
  expect_fault(format_model(kModel) + "\n", ModelFault::kDamaged);
  for (const auto& [what, instead] :
       {std::pair{"11.11107", "nan"},
        {"11.11107", "-1"},
        {"11.11107", "256"},
        {"22.556", "0"},
        {"22.556", "inf"},
        {"22.556", "22.556 7"},
        {"class 100", "class 50"},
        {"mean_levels", "mean_m"},
        {"class 200 mean_levels 71.314 sigma_levels 51.575\n", ""},
        {"51.575\n", "51.575\nclass 255 mean_levels 1 sigma_levels 1\n"}}) {
    expect_fault(sealed(with(lines, what, instead)), ModelFault::kValues);
  }
}

RC_GTEST_PROP(ModelText, ArbitraryTextIsRefused, (const std::string& text)) {
  RC_ASSERT(std::holds_alternative<ModelFault>(parse_model(text)));
}

RC_GTEST_PROP(Crc32, EqualsZlibs, (const std::string& text)) {
  const auto* bytes = reinterpret_cast<const Bytef*>(text.data());
  RC_ASSERT(crc32_of(text) == ::crc32(0, bytes, static_cast<uInt>(text.size())));
}

}  // namespace
}  // namespace roomwise::segment
