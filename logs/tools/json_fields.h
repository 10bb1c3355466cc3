#pragma once
#include <fmt/format.h>

#include <cmath>
#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "roomwise/all_fields.hpp"

namespace roomwise {

/// RFC 4648, with padding.
std::string base64(std::span<const std::uint8_t> bytes);

/// A string in quotes; what is not printable ASCII becomes \u00XX, byte by byte.
std::string json_string(std::string_view text);

template <class Value>
std::string as_json(const Value& value);

/// A message's fields as the members of a JSON object. Visitor for MessageFields. Bytes become
/// base64; numbers that are not finite, which JSON has no word for, null.
class JsonFields {
 public:
  template <class Value>
  void value(std::string_view name, const Value& value) {
    add(name, as_json(value));
  }
  template <class Value>
  void array(std::string_view name, std::span<Value> values) {
    add(name, list_of(values));
  }
  template <class Element>
  void list(std::string_view name, std::string_view, const std::vector<Element>& elements) {
    add(name, list_of(elements));
  }
  void blob(std::string_view name, std::string_view, const std::vector<std::uint8_t>& bytes) {
    add(name, json_string(base64(bytes)));
  }
  std::string object() const { return '{' + members_ + '}'; }

 private:
  template <class Values>
  static std::string list_of(const Values& values) {
    std::string text;
    for (const auto& value : values) {
      if (!text.empty()) text += ',';
      text += as_json(value);
    }
    return '[' + text + ']';
  }
  void add(std::string_view name, const std::string& json) {
    if (!members_.empty()) members_ += ',';
    members_ += json_string(name) + ':' + json;
  }
  std::string members_;
};

template <class Value>
std::string as_json(const Value& value) {
  if constexpr (std::same_as<Value, std::string>) {
    return json_string(value);
  } else if constexpr (std::floating_point<std::remove_cv_t<Value>>) {
    return std::isfinite(value) ? fmt::format("{}", value) : "null";
  } else if constexpr (std::integral<std::remove_cv_t<Value>>) {
    return fmt::format("{}", value);
  } else {
    JsonFields fields;
    MessageFields<std::remove_cv_t<Value>>::visit(value, fields);
    return fields.object();
  }
}

template <class Value>
std::string json_schema_of();

/// The JSON Schema of a message's fields, as JsonFields writes them. Visitor for MessageFields.
class JsonSchemaFields {
 public:
  template <class Value>
  void value(std::string_view name, const Value&) {
    add(name, json_schema_of<std::remove_cv_t<Value>>());
  }
  template <class Value>
  void array(std::string_view name, std::span<Value>) {
    add(name, list_of<std::remove_cv_t<Value>>());
  }
  template <class Element>
  void list(std::string_view name, std::string_view, const std::vector<Element>&) {
    add(name, list_of<Element>());
  }
  void blob(std::string_view name, std::string_view, const std::vector<std::uint8_t>&) {
    add(name, R"({"type":"string","contentEncoding":"base64"})");
  }
  std::string schema() const { return R"({"type":"object","properties":{)" + properties_ + "}}"; }

 private:
  template <class Element>
  static std::string list_of() {
    return R"({"type":"array","items":)" + json_schema_of<Element>() + '}';
  }
  void add(std::string_view name, const std::string& schema) {
    if (!properties_.empty()) properties_ += ',';
    properties_ += json_string(name) + ':' + schema;
  }
  std::string properties_;
};

template <class Value>
std::string json_schema_of() {
  if constexpr (std::same_as<Value, std::string>) {
    return R"({"type":"string"})";
  } else if constexpr (std::floating_point<Value>) {
    return R"({"type":"number"})";
  } else if constexpr (std::integral<Value>) {
    return R"({"type":"integer"})";
  } else {
    JsonSchemaFields fields;
    MessageFields<Value>::visit(Value{}, fields);
    return fields.schema();
  }
}

}  // namespace roomwise
