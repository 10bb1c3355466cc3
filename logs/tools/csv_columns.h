#pragma once
#include <fmt/format.h>

#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "roomwise/all_fields.hpp"

namespace roomwise {

/// A message's fields as text, one cell a column. Visitor for MessageFields; which columns there
/// are depends on the type alone.
///
///   number, string      one column
///   array[3]            columns array[0] array[1] array[2]
///   list of numbers     one column, "1;2;3"
///   list of messages    a column for each of their fields, landmarks.range_m: "1.2;3.4"
///   blob                one column, its size in bytes
class CsvColumns {
 public:
  struct Column {
    std::string name;
    std::string cell;
  };
  const std::vector<Column>& columns() const { return columns_; }

  template <class Value>
  void value(std::string_view name, const Value& value) {
    columns_.push_back({std::string(name), cell(value)});
  }

  template <class Value>
  void array(std::string_view name, std::span<Value> values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      columns_.push_back({fmt::format("{}[{}]", name, i), cell(values[i])});
    }
  }

  template <class Element>
  void list(std::string_view name, std::string_view, const std::vector<Element>& elements) {
    if constexpr (std::integral<Element> || std::floating_point<Element>) {
      columns_.push_back({std::string(name), joined(elements)});
    } else {
      list_of_messages(name, elements);
    }
  }

  void blob(std::string_view name, std::string_view, const std::vector<std::uint8_t>& bytes) {
    columns_.push_back({std::string(name), fmt::format("{}", bytes.size())});
  }

 private:
  static std::string cell(const std::string& text) { return text; }
  template <class Number>
  static std::string cell(Number number) {
    return fmt::format("{}", number);  // shortest text that reads back as the same number
  }

  template <class Number>
  static std::string joined(const std::vector<Number>& numbers) {
    std::string text;
    for (const Number number : numbers) {
      if (!text.empty()) text += ';';
      text += cell(number);
    }
    return text;
  }

  template <class Element>
  void list_of_messages(std::string_view name, const std::vector<Element>& elements) {
    const std::size_t first = columns_.size();
    CsvColumns names;
    MessageFields<Element>::visit(Element{}, names);
    for (const Column& column : names.columns()) {
      columns_.push_back({fmt::format("{}.{}", name, column.name), ""});
    }
    for (std::size_t i = 0; i < elements.size(); ++i) {
      CsvColumns cells;
      MessageFields<Element>::visit(elements[i], cells);
      for (std::size_t k = 0; k < cells.columns_.size(); ++k) {
        if (i > 0) columns_[first + k].cell += ';';
        columns_[first + k].cell += cells.columns_[k].cell;
      }
    }
  }

  std::vector<Column> columns_;
};

/// The columns of a message of this type.
template <class Message>
std::vector<std::string> csv_header() {
  CsvColumns visitor;
  MessageFields<Message>::visit(Message{}, visitor);
  std::vector<std::string> names;
  for (const auto& column : visitor.columns()) names.push_back(column.name);
  return names;
}

/// The cells of `message`, in the order of csv_header().
template <class Message>
std::vector<std::string> csv_row(const Message& message) {
  CsvColumns visitor;
  MessageFields<Message>::visit(message, visitor);
  std::vector<std::string> cells;
  for (const auto& column : visitor.columns()) cells.push_back(column.cell);
  return cells;
}

}  // namespace roomwise
