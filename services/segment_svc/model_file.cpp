#include "services/segment_svc/model_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace roomwise::segment {
namespace {

constexpr std::string_view kFirstLine = "roomwise-segment-model 1 gaussian\n";
constexpr std::string_view kFormatName = "roomwise-segment-model ";

std::string crc_line(std::string_view text) {
  const uLong crc =
      ::crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size()));
  return fmt::format("crc32 {:08x}\n", crc);
}

GreyGaussian read_class(std::istream& text, int expected_label, std::string_view source) {
  std::string word_class;
  std::string word_mean;
  std::string word_sigma;
  int label = -1;
  GreyGaussian gaussian;
  text >> word_class >> label >> word_mean >> gaussian.mean_levels >> word_sigma >>
      gaussian.sigma_levels;
  const bool is_read = text && word_class == "class" && word_mean == "mean_levels" &&
                       word_sigma == "sigma_levels" && label == expected_label;
  const bool is_sound = gaussian.mean_levels >= 0.0 && gaussian.mean_levels <= 255.0 &&
                        gaussian.sigma_levels >= kSigmaMin_levels && gaussian.sigma_levels <= 255.0;
  if (!is_read || !is_sound) {
    throw std::runtime_error(
        fmt::format("{}: class {} must have mean_levels in [0, 255] and sigma_levels in [{}, 255]",
                    source, expected_label, kSigmaMin_levels));
  }
  return gaussian;
}

[[noreturn]] void refuse(const std::filesystem::path& path) {
  throw std::runtime_error(fmt::format("{}: {}", path.string(), std::strerror(errno)));
}

void write_and_flush(const std::filesystem::path& path, const std::string& text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) refuse(path);
  const bool is_written =
      ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
      ::fsync(file) == 0;
  ::close(file);
  if (!is_written) refuse(path);
}

}  // namespace

std::string format_model(const GreyClassifier::Gaussians& gaussians) {
  std::string text(kFirstLine);
  for (std::size_t k = 0; k < gaussians.size(); ++k) {
    text += fmt::format("class {} mean_levels {} sigma_levels {}\n",
                        static_cast<int>(GreyClassifier::kClasses[k]), gaussians[k].mean_levels,
                        gaussians[k].sigma_levels);
  }
  return text + crc_line(text);
}

GreyClassifier::Gaussians parse_model(std::string_view text, std::string_view source) {
  const auto refuse_for = [&](std::string_view reason) {
    throw std::runtime_error(fmt::format("{}: {}", source, reason));
  };
  if (!text.starts_with(kFormatName)) refuse_for("not a segmentation model");
  if (!text.starts_with(kFirstLine)) {
    refuse_for(fmt::format("model of another version or kind; this program reads \"{}\"",
                           kFirstLine.substr(0, kFirstLine.size() - 1)));
  }
  const std::size_t crc_start = text.rfind("crc32 ");
  if (crc_start == std::string_view::npos) refuse_for("cut: no CRC at its end");
  const std::string_view content = text.substr(0, crc_start);
  if (text.substr(crc_start) != crc_line(content)) refuse_for("damaged: CRC differs");

  std::istringstream lines{std::string(content.substr(kFirstLine.size()))};
  GreyClassifier::Gaussians gaussians;
  for (std::size_t k = 0; k < gaussians.size(); ++k) {
    gaussians[k] = read_class(lines, GreyClassifier::kClasses[k], source);
  }
  if (!(lines >> std::ws).eof()) refuse_for("more lines than a model has");
  return gaussians;
}

GreyClassifier::Gaussians load_model(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + ": cannot read model");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return parse_model(text, path.string());
}

void save_model(const std::filesystem::path& path, const GreyClassifier::Gaussians& gaussians) {
  const std::filesystem::path unfinished = path.string() + ".part";
  write_and_flush(unfinished, format_model(gaussians));
  if (::rename(unfinished.c_str(), path.c_str()) != 0) refuse(path);
}

}  // namespace roomwise::segment
