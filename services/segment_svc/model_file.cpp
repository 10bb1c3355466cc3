#include "services/segment_svc/model_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <variant>

#include "services/segment_svc/core/color/model_text.h"

namespace roomwise::segment {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, std::string_view reason) {
  throw std::runtime_error(fmt::format("{}: {}", path.string(), reason));
}

void write_and_flush(const std::filesystem::path& path, const std::string& text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) refuse(path, std::strerror(errno));
  const bool is_written =
      ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
      ::fsync(file) == 0;
  const int error = errno;
  ::close(file);
  if (!is_written) refuse(path, std::strerror(error));
}

}  // namespace

ColorModel load_model(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(path, "cannot read the model");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  auto model = parse_model(text);
  if (const auto* fault = std::get_if<ModelFault>(&model)) refuse(path, reason_of(*fault));
  return std::get<ColorModel>(std::move(model));
}

void save_model(const std::filesystem::path& path, const ColorModel& model) {
  const std::filesystem::path unfinished = path.string() + ".part";
  write_and_flush(unfinished, format_model(model));
  if (::rename(unfinished.c_str(), path.c_str()) != 0) refuse(path, std::strerror(errno));
}

}  // namespace roomwise::segment
