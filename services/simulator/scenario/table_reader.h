#pragma once
#include <toml++/toml.h>

#include <Eigen/Core>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace roomwise::simulator {

/// The values a number may take, ends included.
struct Limits {
  double least;
  double largest;
};

/// Reads one TOML table strictly: each key is asked for by name, type and limits; what nobody asked
/// for is refused. Every error is a std::runtime_error "source:line: table.key must be ...".
/// Refers to the table and the source, which must outlive it.
class TableReader {
 public:
  /// `name` as errors show it, such as "box"; empty for the whole file.
  TableReader(const toml::table& table, std::string_view source, std::string name);

  /// Without a fallback the key must be there.
  double number(std::string_view key, Limits limits, std::optional<double> fallback = {});
  int whole(std::string_view key, int least, int largest, std::optional<int> fallback = {});
  bool flag(std::string_view key, bool fallback);
  /// 1 to 64 letters, digits, '_', '-', '.'.
  std::string name(std::string_view key);
  /// Index of the text among `allowed`.
  std::size_t choice(std::string_view key, const std::vector<std::string>& allowed,
                     std::optional<std::size_t> fallback = {});

  Eigen::Vector2d vector2(std::string_view key, Limits limits,
                          std::optional<Eigen::Vector2d> fallback = {});
  Eigen::Vector3d vector3(std::string_view key, Limits limits,
                          std::optional<Eigen::Vector3d> fallback = {});
  std::vector<Eigen::Vector2d> points2(std::string_view key, Limits limits, std::size_t least,
                                       std::size_t most);
  std::vector<Eigen::Vector3d> points3(std::string_view key, Limits limits, std::size_t least,
                                       std::size_t most);

  bool has(std::string_view key);
  /// The table under `key`; none if it is not there.
  std::optional<TableReader> table(std::string_view key);
  /// The array of tables under `key`, at most `most`; empty if it is not there.
  std::vector<TableReader> tables(std::string_view key, std::size_t most);

  /// Refuses keys that were never asked for.
  void finish() const;
  [[noreturn]] void refuse(std::string_view key, const std::string& what) const;
  /// "source:line" of the table.
  std::string where() const;

 private:
  const toml::node* find(std::string_view key);
  const toml::node& need(std::string_view key, const std::string& what);
  std::vector<std::vector<double>> rows(std::string_view key, Limits limits, std::size_t columns,
                                        std::size_t least, std::size_t most);

  const toml::table* table_;
  std::string_view source_;
  std::string name_;
  std::set<std::string, std::less<>> asked_;
};

}  // namespace roomwise::simulator
