#include "common/params/params.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <functional>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace roomwise {
namespace {

template <class... Visitors>
struct Overloaded : Visitors... {
  using Visitors::operator()...;
};
template <class... Visitors>
Overloaded(Visitors...) -> Overloaded<Visitors...>;

/// What a field may hold, to follow "must be".
std::string allowed_values(const ParamField& field) {
  return std::visit(
      Overloaded{[](const ParamField::Range<double>& r) {
                   return fmt::format("a number in [{}, {}]", r.smallest, r.largest);
                 },
                 [](const ParamField::Range<int>& r) {
                   return fmt::format("a whole number in [{}, {}]", r.smallest, r.largest);
                 },
                 [](bool*) { return std::string("true or false"); },
                 [](const ParamField::Choice& c) {
                   return c.allowed.empty()
                              ? std::string("a text")
                              : fmt::format("one of \"{}\"", fmt::join(c.allowed, "\", \""));
                 },
                 [](std::vector<std::string>*) { return std::string("a list of texts"); }},
      field.slot);
}

bool contains(const std::vector<std::string>& allowed, const std::string& value) {
  return allowed.empty() || std::find(allowed.begin(), allowed.end(), value) != allowed.end();
}

std::function<void()> list_assignment(const toml::node& node, std::vector<std::string>* target) {
  const toml::array* array = node.as_array();
  if (array == nullptr) return {};
  std::vector<std::string> values;
  for (const toml::node& element : *array) {
    if (!element.is_string()) return {};
    values.push_back(*element.value<std::string>());
  }
  return [target, values] { *target = values; };
}

/// The assignment that puts `node` into the field; empty if the field may not hold it.
std::function<void()> assignment(const toml::node& node, const ParamField& field) {
  return std::visit(Overloaded{[&](const ParamField::Range<double>& r) -> std::function<void()> {
                                 if (!node.is_number()) return {};
                                 // None for whole numbers that no double equals.
                                 const std::optional<double> value = node.value<double>();
                                 if (!value || !(*value >= r.smallest && *value <= r.largest))
                                   return {};
                                 return [r, value] { *r.value = *value; };
                               },
                               [&](const ParamField::Range<int>& r) -> std::function<void()> {
                                 if (!node.is_integer()) return {};
                                 const auto value = *node.value<std::int64_t>();
                                 if (value < r.smallest || value > r.largest) return {};
                                 return [r, value] { *r.value = static_cast<int>(value); };
                               },
                               [&](bool* target) -> std::function<void()> {
                                 if (!node.is_boolean()) return {};
                                 const bool value = *node.value<bool>();
                                 return [target, value] { *target = value; };
                               },
                               [&](std::vector<std::string>* target) -> std::function<void()> {
                                 return list_assignment(node, target);
                               },
                               [&](const ParamField::Choice& c) -> std::function<void()> {
                                 if (!node.is_string()) return {};
                                 std::string value = *node.value<std::string>();
                                 if (!contains(c.allowed, value)) return {};
                                 return [target = c.value, value] { *target = value; };
                               }},
                    field.slot);
}

const ParamField* find_field(const ParamFields& fields, std::string_view name) {
  for (const ParamField& field : fields.fields()) {
    if (field.name == name) return &field;
  }
  return nullptr;
}

std::string names_of(const ParamFields& fields) {
  std::string names;
  for (const ParamField& field : fields.fields()) {
    names += (names.empty() ? "" : ", ") + field.name;
  }
  return names;
}

/// A double in the fewest digits that read back exactly, always with a point or an exponent.
std::string toml_number(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

/// A one-line TOML string; toml++ itself would print a leading line feed so that it is lost on
/// reading.
std::string toml_string(const std::string& value) {
  std::string text = "\"";
  for (const char c : value) {
    const bool plain = static_cast<unsigned char>(c) >= 0x20U && c != '"' && c != '\\' && c != 0x7f;
    text += plain ? std::string(1, c) : fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
  }
  return text + "\"";
}

std::string toml_list(const std::vector<std::string>& values) {
  std::string text = "[";
  for (const std::string& value : values) text += (text == "[" ? "" : ", ") + toml_string(value);
  return text + "]";
}

std::string toml_value(const ParamField& field) {
  return std::visit(
      Overloaded{[](const ParamField::Range<double>& r) { return toml_number(*r.value); },
                 [](const ParamField::Range<int>& r) { return fmt::format("{}", *r.value); },
                 [](bool* value) { return std::string(*value ? "true" : "false"); },
                 [](const ParamField::Choice& c) { return toml_string(*c.value); },
                 [](std::vector<std::string>* values) { return toml_list(*values); }},
      field.slot);
}

}  // namespace

void apply_toml(std::string_view toml, std::string_view source, const ParamFields& fields) {
  std::vector<std::function<void()>> assignments;
  try {
    const toml::table table = toml::parse(toml, source);
    for (const auto& [key, node] : table) {
      const auto refuse = [&, name = key.str(),
                           line = node.source().begin.line](const std::string& what) {
        throw std::runtime_error(fmt::format("{}:{}: {} must be {}", source, line, name, what));
      };
      const ParamField* field = find_field(fields, key.str());
      if (field == nullptr) refuse("one of the parameters " + names_of(fields));
      auto assign = assignment(node, *field);
      if (!assign) refuse(allowed_values(*field));
      assignments.push_back(std::move(assign));
    }
  } catch (const toml::parse_error& error) {
    throw std::runtime_error(fmt::format("{}:{}: text must be TOML: {}", source,
                                         error.source().begin.line, error.description()));
  }
  for (const auto& assign : assignments) assign();
}

void apply_text(const ParamField& field, const std::vector<std::string>& texts,
                const ParamFields& fields) {
  const std::string& last = texts.back();
  const std::string value =
      std::visit(Overloaded{[&](const auto&) { return last; },
                            [&](const ParamField::Choice&) { return toml_string(last); },
                            [&](std::vector<std::string>*) { return toml_list(texts); }},
                 field.slot);
  apply_toml(fmt::format("{} = {}", field.name, value), "command line", fields);
}

std::string to_toml(const ParamFields& fields) {
  std::string text;
  for (const ParamField& field : fields.fields()) {
    text += fmt::format("{} = {}\n", field.name, toml_value(field));
  }
  return text;
}

void load_params_file(const std::filesystem::path& path, const ParamFields& fields) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) {
    throw std::runtime_error(fmt::format("{}: cannot read parameters", path.string()));
  }
  apply_toml(text.str(), path.string(), fields);
}

}  // namespace roomwise
