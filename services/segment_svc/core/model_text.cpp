#include "services/segment_svc/core/model_text.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace roomwise::segment {
namespace {

constexpr std::string_view kName = "roomwise-segment-model ";
constexpr std::string_view kFirstLine = "roomwise-segment-model 1 gaussian\n";
constexpr std::string_view kCrc = "crc32 ";

constexpr std::array<std::uint32_t, 256> make_crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t rest = byte;
    for (int bit = 0; bit < 8; ++bit) rest = rest >> 1U ^ ((rest & 1U) != 0 ? 0xedb88320U : 0U);
    table[byte] = rest;
  }
  return table;
}

/// The shortest text that reads back as exactly this number.
std::string text_of(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

std::string crc_line(std::string_view lines) {
  std::uint32_t crc = crc32_of(lines);
  std::string hex(8, '0');
  for (auto digit = hex.rbegin(); digit != hex.rend(); ++digit, crc >>= 4U) {
    *digit = "0123456789abcdef"[crc & 15U];
  }
  return std::string(kCrc) + hex + "\n";
}

/// Takes the text up to `end` off the front of `rest`.
std::string_view take_until(std::string_view& rest, char end) {
  const std::string_view taken = rest.substr(0, rest.find(end));
  rest.remove_prefix(std::min(rest.size(), taken.size() + 1));
  return taken;
}

double number_in(std::string_view text) {
  double value = -1.0;  // no class has it
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : -1.0;
}

bool is_sound(const GreyGaussian& gaussian) {
  return gaussian.mean_levels >= 0.0 && gaussian.mean_levels <= 255.0 &&
         gaussian.sigma_levels >= kSigmaMin_levels && gaussian.sigma_levels <= 255.0;
}

/// "class 0 mean_levels 31.25 sigma_levels 12.5", but for the words, which the caller compares.
GreyGaussian gaussian_in(std::string_view line) {
  for (int word = 0; word < 3; ++word) take_until(line, ' ');
  const double mean_levels = number_in(take_until(line, ' '));
  take_until(line, ' ');
  return {.mean_levels = mean_levels, .sigma_levels = number_in(line)};
}

}  // namespace

std::uint32_t crc32_of(std::string_view text) {
  static constexpr auto kTable = make_crc_table();
  std::uint32_t crc = 0xffffffffU;
  for (const char c : text) crc = crc >> 8U ^ kTable[(crc ^ static_cast<std::uint8_t>(c)) & 255U];
  return ~crc;
}

std::string format_model(const GreyClassifier::Gaussians& gaussians) {
  std::string text(kFirstLine);
  for (std::size_t k = 0; k < gaussians.size(); ++k) {
    text += "class " + std::to_string(GreyClassifier::kClasses[k]);
    text += " mean_levels " + text_of(gaussians[k].mean_levels);
    text += " sigma_levels " + text_of(gaussians[k].sigma_levels) + "\n";
  }
  return text + crc_line(text);
}

std::string_view reason_of(ModelFault fault) {
  switch (fault) {
    case ModelFault::kForeign:
      return "not a segmentation model";
    case ModelFault::kVersion:
      return "model of another version or kind; this program reads version 1, gaussian";
    case ModelFault::kCut:
      return "cut: no CRC at its end";
    case ModelFault::kDamaged:
      return "damaged: its CRC differs";
    case ModelFault::kValues:
      return "must have classes 0, 100 and 200 with mean_levels in [0, 255] and sigma_levels in "
             "[0.289, 255]";
  }
  return "refused";
}

std::variant<GreyClassifier::Gaussians, ModelFault> parse_model(std::string_view text) {
  if (!text.starts_with(kName)) return ModelFault::kForeign;
  if (!text.starts_with(kFirstLine)) return ModelFault::kVersion;
  const std::size_t crc_start = text.rfind(kCrc);
  if (crc_start == std::string_view::npos) return ModelFault::kCut;
  std::string_view lines = text.substr(0, crc_start);
  if (text.substr(crc_start) != crc_line(lines)) return ModelFault::kDamaged;

  lines.remove_prefix(kFirstLine.size());
  GreyClassifier::Gaussians gaussians;
  for (GreyGaussian& gaussian : gaussians) {
    gaussian = gaussian_in(take_until(lines, '\n'));
    if (!is_sound(gaussian)) return ModelFault::kValues;
  }
  // Words, order and number of lines: what was read must be what would be written.
  if (format_model(gaussians) != text) return ModelFault::kValues;
  return gaussians;
}

}  // namespace roomwise::segment
