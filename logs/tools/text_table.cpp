#include "logs/tools/text_table.h"

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace roomwise {
namespace {

template <class Number>
bool parse(std::string_view text, Number& number) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
}

}  // namespace

TextTable::TextTable(const std::filesystem::path& path) : path_(path), file_(path) {
  if (!file_ || std::filesystem::is_directory(path)) {
    throw std::runtime_error(fmt::format("{}: cannot read", path.string()));
  }
}

bool TextTable::next(std::size_t fewest) {
  std::string line;
  while (std::getline(file_, line)) {
    ++line_;
    std::istringstream row(line.substr(0, line.find('#')));
    fields_.clear();
    for (std::string field; row >> field;) fields_.push_back(field);
    if (fields_.empty()) continue;
    if (fields_.size() < fewest) {
      refuse(fmt::format("has {} fields, needs {}", fields_.size(), fewest));
    }
    return true;
  }
  return false;
}

double TextTable::number(std::size_t field, std::string_view what) const {
  double value = 0.0;
  if (!parse(text(field), value) || !std::isfinite(value)) {
    refuse(fmt::format("{} must be a number, is '{}'", what, text(field)));
  }
  return value;
}

int TextTable::integer(std::size_t field, std::string_view what) const {
  int value = 0;
  if (!parse(text(field), value)) {
    refuse(fmt::format("{} must be a whole number, is '{}'", what, text(field)));
  }
  return value;
}

std::int64_t TextTable::utime(std::size_t field, std::string_view what) const {
  constexpr double kLatest_s = 9.2e9;
  const double time_s = number(field, what);
  if (time_s < 0.0 || time_s > kLatest_s) {
    refuse(fmt::format("{} must be seconds since the epoch, is '{}'", what, text(field)));
  }
  return std::llround(time_s * 1e6);
}

void TextTable::refuse(std::string_view complaint) const {
  throw std::runtime_error(fmt::format("{}:{}: {}", path_.string(), line_, complaint));
}

}  // namespace roomwise
