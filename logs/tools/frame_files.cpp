#include "logs/tools/frame_files.h"

#include <fmt/core.h>

#include <charconv>
#include <optional>
#include <stdexcept>
#include <string>

namespace roomwise {
namespace {

std::optional<int> frame_number(std::string_view name, std::string_view ending) {
  constexpr std::string_view kStart = "frame-";
  constexpr std::size_t kMostDigits = 9;
  if (!name.starts_with(kStart) || !name.ends_with(ending)) return std::nullopt;
  if (name.size() <= kStart.size() + ending.size()) return std::nullopt;
  const std::string_view digits =
      name.substr(kStart.size(), name.size() - kStart.size() - ending.size());
  if (digits.size() > kMostDigits || digits.front() == '-') return std::nullopt;
  int number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return number;
}

}  // namespace

std::map<int, std::filesystem::path> find_frame_files(const std::filesystem::path& folder,
                                                      std::string_view ending) {
  if (!std::filesystem::is_directory(folder)) {
    throw std::runtime_error(fmt::format("{}: not a folder", folder.string()));
  }
  std::map<int, std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (const auto number = frame_number(name, ending)) files[*number] = entry.path();
  }
  if (files.empty()) {
    throw std::runtime_error(fmt::format("{}: holds no frame-N{}", folder.string(), ending));
  }
  return files;
}

}  // namespace roomwise
