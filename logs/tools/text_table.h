#pragma once
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace roomwise {

/// Reads a text file of fields between white space, a row a line; `#` starts a comment, empty lines
/// are left out. Every complaint is a std::runtime_error that begins with "file:line: ".
class TextTable {
 public:
  /// Throws std::runtime_error naming the file if it cannot be opened.
  explicit TextTable(const std::filesystem::path& path);

  /// Goes to the next row; false at the end. Throws unless it has at least `fewest` fields.
  bool next(std::size_t fewest);

  std::size_t size() const { return fields_.size(); }
  const std::string& text(std::size_t field) const { return fields_.at(field); }

  /// A finite number. `what` names it in the complaint.
  double number(std::size_t field, std::string_view what) const;
  int integer(std::size_t field, std::string_view what) const;
  /// Seconds since the epoch as microseconds, rounded; at least 0 and before the year 2262.
  std::int64_t utime(std::size_t field, std::string_view what) const;

  [[noreturn]] void refuse(std::string_view complaint) const;

 private:
  std::filesystem::path path_;
  std::ifstream file_;
  int line_ = 0;
  std::vector<std::string> fields_;
};

}  // namespace roomwise
