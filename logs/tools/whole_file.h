#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

namespace roomwise {

/// A file that appears only when it is whole: written beside its place under another name and
/// renamed by commit(). Without commit() nothing stays and an older file is left as it was.
class ReplacedFile {
 public:
  explicit ReplacedFile(const std::filesystem::path& path);
  ReplacedFile(const ReplacedFile&) = delete;
  ReplacedFile& operator=(const ReplacedFile&) = delete;
  ~ReplacedFile();

  /// Where to write meanwhile.
  const std::filesystem::path& temporary() const { return temporary_; }

  /// Throws std::runtime_error naming the file if it cannot take its place.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
};

/// Writes `bytes` to `path`, whole or not at all. Throws std::runtime_error naming the file.
void write_whole_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
void write_whole_file(const std::filesystem::path& path, std::string_view text);

/// The bytes of `path`. Throws std::runtime_error naming the file.
std::vector<std::uint8_t> read_whole_file(const std::filesystem::path& path);

}  // namespace roomwise
