#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace roomwise {

/// A whole file's bytes, read through the page cache.
class MappedFile {
 public:
  /// Throws std::runtime_error "path: reason" if it is not a readable regular file.
  explicit MappedFile(const std::filesystem::path& path);
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile();

  std::span<const std::uint8_t> bytes() const { return bytes_; }

 private:
  std::span<const std::uint8_t> bytes_;
};

}  // namespace roomwise
