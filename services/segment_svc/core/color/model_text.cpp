#include "services/segment_svc/core/color/model_text.h"

#include <zlib.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace roomwise::segment {
namespace {

constexpr std::string_view kName = "roomwise-segment-model ";
constexpr std::string_view kFirstLine = "roomwise-segment-model 2\n";
constexpr std::string_view kCrc = "crc32 ";

/// Logarithms of levels from 1 to 256 and of their ratios lie within this.
constexpr double kFeatureMax = 6.0;
constexpr double kVarianceMax = 4.0 * kFeatureMax * kFeatureMax;

/// The shortest text that reads back as exactly this number.
std::string text_of(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string crc_line(std::string_view lines) {
  const auto* bytes = reinterpret_cast<const Bytef*>(lines.data());
  auto crc = ::crc32(0, bytes, static_cast<uInt>(lines.size()));
  std::string hex(8, '0');
  for (auto digit = hex.rbegin(); digit != hex.rend(); ++digit, crc >>= 4U) {
    *digit = "0123456789abcdef"[crc & 15U];
  }
  return std::string(kCrc) + hex + "\n";
}

std::string class_line(Label label, const GreyGaussian& grey) {
  return "class " + std::to_string(label) + " mean_levels " + text_of(grey.mean_levels) +
         " sigma_levels " + text_of(grey.sigma_levels) + "\n";
}

std::string part_line(const MixturePart& part) {
  std::string line = "part " + text_of(part.weight_ratio);
  for (int i = 0; i < 3; ++i) line += " " + text_of(part.mean[i]);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) line += " " + text_of(part.covariance(i, j));
  }
  return line + "\n";
}

/// Takes the text up to `end` off the front of `rest`.
std::string_view take_until(std::string_view& rest, char end) {
  const std::string_view taken = rest.substr(0, rest.find(end));
  rest.remove_prefix(std::min(rest.size(), taken.size() + 1));
  return taken;
}

/// Not a number where there is none.
double number_in(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_all = error == std::errc() && end == text.data() + text.size();
  return is_all ? value : std::numeric_limits<double>::quiet_NaN();
}

/// "class 0 mean_levels 31.25 sigma_levels 12.5", but for the words, which the caller compares.
std::optional<GreyGaussian> gaussian_in(std::string_view line) {
  for (int word = 0; word < 3; ++word) take_until(line, ' ');
  const double mean_levels = number_in(take_until(line, ' '));
  take_until(line, ' ');
  const double sigma_levels = number_in(line);
  const bool is_sound = mean_levels >= 0.0 && mean_levels <= 255.0 &&
                        sigma_levels >= kSigmaMin_levels && sigma_levels <= 255.0;
  if (!is_sound) return std::nullopt;
  return GreyGaussian{.mean_levels = mean_levels, .sigma_levels = sigma_levels};
}

bool is_sound(const MixturePart& part) {
  const bool is_in_range = part.weight_ratio > 0.0 && part.weight_ratio <= 1.0 &&
                           part.mean.array().abs().maxCoeff() <= kFeatureMax &&
                           part.covariance.array().abs().maxCoeff() <= kVarianceMax;
  return is_in_range && part.mean.allFinite() && part.covariance.allFinite() &&
         Eigen::LLT<Eigen::Matrix3d>(part.covariance).info() == Eigen::Success;
}

std::optional<MixturePart> part_in(std::string_view line) {
  take_until(line, ' ');
  MixturePart part;
  part.weight_ratio = number_in(take_until(line, ' '));
  for (int i = 0; i < 3; ++i) part.mean[i] = number_in(take_until(line, ' '));
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j <= i; ++j) {
      part.covariance(i, j) = part.covariance(j, i) = number_in(take_until(line, ' '));
    }
  }
  if (!is_sound(part)) return std::nullopt;
  return part;
}

std::optional<Mixture> mixture_in(std::string_view& lines) {
  std::vector<MixturePart> parts;
  while (lines.starts_with("part ")) {
    const auto part = part_in(take_until(lines, '\n'));
    if (!part || parts.size() == kMixturePartsMax) return std::nullopt;
    parts.push_back(*part);
  }
  if (parts.empty()) return std::nullopt;
  return Mixture(std::move(parts));
}

std::optional<ColorModel> model_in(std::string_view lines) {
  GreyClassifier::Gaussians grey;
  std::array<std::optional<Mixture>, kTrainedClasses.size()> mixtures;
  for (std::size_t k = 0; k < kTrainedClasses.size(); ++k) {
    const auto gaussian = gaussian_in(take_until(lines, '\n'));
    mixtures[k] = mixture_in(lines);
    if (!gaussian || !mixtures[k]) return std::nullopt;
    grey[k] = *gaussian;
  }
  return ColorModel{.grey = grey, .mixtures = {*mixtures[0], *mixtures[1], *mixtures[2]}};
}

}  // namespace

std::string format_model(const ColorModel& model) {
  std::string text(kFirstLine);
  for (std::size_t k = 0; k < kTrainedClasses.size(); ++k) {
    text += class_line(kTrainedClasses[k], model.grey[k]);
    for (const MixturePart& part : model.mixtures[k].parts()) text += part_line(part);
  }
  return text + crc_line(text);
}

std::string_view reason_of(ModelFault fault) {
  switch (fault) {
    case ModelFault::kForeign:
      return "not a segmentation model";
    case ModelFault::kVersion:
      return "model of another version; this program reads version 2: train it again";
    case ModelFault::kCut:
      return "cut: no CRC at its end";
    case ModelFault::kDamaged:
      return "damaged: its CRC differs";
    case ModelFault::kValues:
      return "must have classes 0, 100 and 200, each with mean_levels in [0, 255], sigma_levels in "
             "[0.289, 255] and 1 to 5 parts that are Gaussians";
  }
  return "refused";
}

std::variant<ColorModel, ModelFault> parse_model(std::string_view text) {
  if (!text.starts_with(kName)) return ModelFault::kForeign;
  if (!text.starts_with(kFirstLine)) return ModelFault::kVersion;
  const std::size_t crc_start = text.rfind(kCrc);
  if (crc_start == std::string_view::npos) return ModelFault::kCut;
  const std::string_view lines = text.substr(0, crc_start);
  if (text.substr(crc_start) != crc_line(lines)) return ModelFault::kDamaged;
  std::optional<ColorModel> model = model_in(lines.substr(kFirstLine.size()));
  // Words, order and number of lines: what was read must be what would be written.
  if (!model || format_model(*model) != text) return ModelFault::kValues;
  return *std::move(model);
}

}  // namespace roomwise::segment
