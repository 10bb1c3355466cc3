#include "logs/tools/whole_file.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace roomwise {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const char* what, int error) {
  throw std::runtime_error(fmt::format("{}: {}: {}", path.string(), what, std::strerror(error)));
}

}  // namespace

ReplacedFile::ReplacedFile(const std::filesystem::path& path)
    : path_(path), temporary_(fmt::format("{}.{}.part", path.string(), getpid())) {}

ReplacedFile::~ReplacedFile() {
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void ReplacedFile::commit() {
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) refuse(path_, "cannot write", error.value());
}

void write_whole_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  ReplacedFile file(path);
  std::ofstream out(file.temporary(), std::ios::binary);
  if (!out) refuse(path, "cannot write", errno);
  out.write(reinterpret_cast<const char*>(bytes.data()),
            static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) refuse(path, "cannot write", errno);
  file.commit();
}

void write_whole_file(const std::filesystem::path& path, std::string_view text) {
  write_whole_file(path,
                   std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

std::vector<std::uint8_t> read_whole_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) refuse(path, "cannot read", error.value());
  std::vector<std::uint8_t> bytes(size);
  std::ifstream in(path, std::ios::binary);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!in) refuse(path, "cannot read", errno);
  return bytes;
}

}  // namespace roomwise
