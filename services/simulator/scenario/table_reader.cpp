#include "services/simulator/scenario/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace roomwise::simulator {
namespace {

std::optional<double> number_in(const toml::node& node, Limits limits) {
  const auto value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value || !(*value >= limits.least && *value <= limits.largest)) return std::nullopt;
  return value;
}

/// `columns` numbers; empty if the node is anything else.
std::vector<double> numbers_in(const toml::node& node, Limits limits, std::size_t columns) {
  const toml::array* array = node.as_array();
  std::vector<double> numbers;
  if (array == nullptr || array->size() != columns) return numbers;
  for (const toml::node& element : *array) {
    const auto value = number_in(element, limits);
    if (!value) return {};
    numbers.push_back(*value);
  }
  return numbers;
}

bool is_name(const std::string& text) {
  return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  });
}

std::string numbers_wanted(std::size_t columns, Limits limits) {
  return fmt::format("{} numbers in [{}, {}]", columns, limits.least, limits.largest);
}

}  // namespace

TableReader::TableReader(const toml::table& table, std::string_view source, std::string name)
    : table_(&table), source_(source), name_(std::move(name)) {}

double TableReader::number(std::string_view key, Limits limits, std::optional<double> fallback) {
  if (fallback && find(key) == nullptr) return *fallback;
  const std::string what = fmt::format("a number in [{}, {}]", limits.least, limits.largest);
  const auto value = number_in(need(key, what), limits);
  if (!value) refuse(key, what);
  return *value;
}

int TableReader::whole(std::string_view key, int least, int largest, std::optional<int> fallback) {
  if (fallback && find(key) == nullptr) return *fallback;
  const std::string what = fmt::format("a whole number in [{}, {}]", least, largest);
  const toml::node& node = need(key, what);
  const auto value = node.is_integer() ? node.value<std::int64_t>() : std::nullopt;
  if (!value || *value < least || *value > largest) refuse(key, what);
  return static_cast<int>(*value);
}

bool TableReader::flag(std::string_view key, bool fallback) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  if (!node->is_boolean()) refuse(key, "true or false");
  return *node->value<bool>();
}

std::string TableReader::name(std::string_view key) {
  const std::string what = "a name of letters, digits, '_', '-', '.'";
  const toml::node& node = need(key, what);
  auto text = node.is_string() ? node.value<std::string>() : std::nullopt;
  if (!text || !is_name(*text)) refuse(key, what);
  return std::move(*text);
}

std::size_t TableReader::choice(std::string_view key, const std::vector<std::string>& allowed,
                                std::optional<std::size_t> fallback) {
  if (fallback && find(key) == nullptr) return *fallback;
  const std::string what = fmt::format("one of \"{}\"", fmt::join(allowed, "\", \""));
  const toml::node& node = need(key, what);
  const auto text = node.is_string() ? node.value<std::string>() : std::nullopt;
  const auto found = text ? std::find(allowed.begin(), allowed.end(), *text) : allowed.end();
  if (found == allowed.end()) refuse(key, what);
  return static_cast<std::size_t>(found - allowed.begin());
}

Eigen::Vector2d TableReader::vector2(std::string_view key, Limits limits,
                                     std::optional<Eigen::Vector2d> fallback) {
  if (fallback && find(key) == nullptr) return *fallback;
  const std::string what = numbers_wanted(2, limits);
  const auto numbers = numbers_in(need(key, what), limits, 2);
  if (numbers.empty()) refuse(key, what);
  return {numbers[0], numbers[1]};
}

Eigen::Vector3d TableReader::vector3(std::string_view key, Limits limits,
                                     std::optional<Eigen::Vector3d> fallback) {
  if (fallback && find(key) == nullptr) return *fallback;
  const std::string what = numbers_wanted(3, limits);
  const auto numbers = numbers_in(need(key, what), limits, 3);
  if (numbers.empty()) refuse(key, what);
  return {numbers[0], numbers[1], numbers[2]};
}

std::vector<std::vector<double>> TableReader::rows(std::string_view key, Limits limits,
                                                   std::size_t columns, std::size_t least,
                                                   std::size_t most) {
  const std::string what =
      fmt::format("{} to {} times {}", least, most, numbers_wanted(columns, limits));
  const toml::array* array = need(key, what).as_array();
  if (array == nullptr || array->size() < least || array->size() > most) refuse(key, what);
  std::vector<std::vector<double>> found;
  for (const toml::node& element : *array) {
    found.push_back(numbers_in(element, limits, columns));
    if (found.back().empty()) refuse(key, what);
  }
  return found;
}

std::vector<Eigen::Vector2d> TableReader::points2(std::string_view key, Limits limits,
                                                  std::size_t least, std::size_t most) {
  std::vector<Eigen::Vector2d> points;
  for (const auto& row : rows(key, limits, 2, least, most)) points.emplace_back(row[0], row[1]);
  return points;
}

std::vector<Eigen::Vector3d> TableReader::points3(std::string_view key, Limits limits,
                                                  std::size_t least, std::size_t most) {
  std::vector<Eigen::Vector3d> points;
  for (const auto& row : rows(key, limits, 3, least, most)) {
    points.emplace_back(row[0], row[1], row[2]);
  }
  return points;
}

bool TableReader::has(std::string_view key) { return find(key) != nullptr; }

std::optional<TableReader> TableReader::table(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  if (!node->is_table()) refuse(key, "a table");
  return TableReader(*node->as_table(), source_, std::string(key));
}

std::vector<TableReader> TableReader::tables(std::string_view key, std::size_t most) {
  std::vector<TableReader> readers;
  const toml::node* node = find(key);
  if (node == nullptr) return readers;
  const std::string what = fmt::format("at most {} tables [[{}]]", most, key);
  const toml::array* array = node->as_array();
  if (array == nullptr || array->size() > most) refuse(key, what);
  for (const toml::node& element : *array) {
    if (!element.is_table()) refuse(key, what);
    readers.emplace_back(*element.as_table(), source_, std::string(key));
  }
  return readers;
}

void TableReader::finish() const {
  for (const auto& [key, node] : *table_) {
    if (!asked_.contains(key.str())) {
      refuse(key.str(), fmt::format("one of {}", fmt::join(asked_, ", ")));
    }
  }
}

void TableReader::refuse(std::string_view key, const std::string& what) const {
  const toml::node* node = table_->get(key);
  const auto line = (node != nullptr ? node : table_)->source().begin.line;
  throw std::runtime_error(fmt::format("{}:{}: {}{}{} must be {}", source_, line, name_,
                                       name_.empty() ? "" : ".", key, what));
}

std::string TableReader::where() const {
  return fmt::format("{}:{}", source_, table_->source().begin.line);
}

const toml::node* TableReader::find(std::string_view key) {
  asked_.emplace(key);
  return table_->get(key);
}

const toml::node& TableReader::need(std::string_view key, const std::string& what) {
  const toml::node* node = find(key);
  if (node == nullptr) refuse(key, "given: " + what);
  return *node;
}

}  // namespace roomwise::simulator
