#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "logs/tools/csv_columns.h"

namespace roomwise {

/// Finds the count that list `wanted` shares with the lists parallel to it. Visitor.
struct CountOfList {
  std::string_view wanted;
  std::string count;  ///< empty: the message has no such list

  template <class Value>
  void value(std::string_view, const Value&) {}
  template <class Value>
  void array(std::string_view, std::span<Value>) {}
  template <class Element>
  void list(std::string_view name, std::string_view count_name, const std::vector<Element>&) {
    if (name == wanted) count = count_name;
  }
  void blob(std::string_view, std::string_view, const std::vector<std::uint8_t>&) {}
};

/// The elements of the lists that share one count, a row for each element. Visitor.
struct CsvElements {
  std::string_view count;
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;

  template <class Value>
  void value(std::string_view, const Value&) {}
  template <class Value>
  void array(std::string_view, std::span<Value>) {}
  template <class Element>
  void list(std::string_view name, std::string_view count_name,
            const std::vector<Element>& elements) {
    if (count_name != count) return;
    rows.resize(elements.size());
    append(columns_of(name, Element{}), &CsvColumns::Column::name, names);
    for (std::size_t i = 0; i < elements.size(); ++i) {
      append(columns_of(name, elements[i]), &CsvColumns::Column::cell, rows[i]);
    }
  }
  void blob(std::string_view, std::string_view, const std::vector<std::uint8_t>&) {}

 private:
  template <class Element>
  static CsvColumns columns_of(std::string_view name, const Element& element) {
    CsvColumns columns;
    if constexpr (std::integral<Element> || std::floating_point<Element>) {
      columns.value(name, element);
    } else {
      MessageFields<Element>::visit(element, columns);
    }
    return columns;
  }
  static void append(const CsvColumns& from, std::string CsvColumns::Column::*part,
                     std::vector<std::string>& to) {
    for (const auto& column : from.columns()) to.push_back(column.*part);
  }
};

}  // namespace roomwise
