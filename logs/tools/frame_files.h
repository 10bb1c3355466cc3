#pragma once
#include <filesystem>
#include <map>
#include <string_view>

namespace roomwise {

/// The files frame-N`ending` of a folder (N: digits) by N. Throws std::runtime_error naming the
/// folder if it is none or holds no such file.
std::map<int, std::filesystem::path> find_frame_files(const std::filesystem::path& folder,
                                                      std::string_view ending);

}  // namespace roomwise
