#include "logs/tools/point_files.h"

#include <fmt/core.h>

#include <bit>
#include <cstring>

namespace roomwise {
namespace {

static_assert(std::endian::native == std::endian::little, "files are written as memory has them");

void append_place(const Eigen::Vector3f& p_m, std::string& text) {
  char bytes[3 * sizeof(float)];
  std::memcpy(bytes, p_m.data(), sizeof bytes);
  text.append(bytes, sizeof bytes);
}

}  // namespace

std::string as_ply(const PointCloud& cloud, const std::string& comment) {
  std::string text = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment {}\nelement vertex {}\n"
      "property float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
      comment, cloud.size());
  text.reserve(text.size() + 15 * cloud.size());
  for (const ColoredPoint& point : cloud) {
    append_place(point.p_m, text);
    for (const std::uint8_t level : point.rgb) text += static_cast<char>(level);
  }
  return text;
}

std::string as_pcd(const PointCloud& cloud, const std::string& comment) {
  std::string text = fmt::format(
      "# .PCD v0.7 - {}\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 4 4\nTYPE F F F F\n"
      "COUNT 1 1 1 1\nWIDTH {}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {}\nDATA binary\n",
      comment, cloud.size(), cloud.size());
  text.reserve(text.size() + 16 * cloud.size());
  for (const ColoredPoint& point : cloud) {
    append_place(point.p_m, text);
    for (std::size_t i = 3; i-- > 0;) text += static_cast<char>(point.rgb[i]);
    text += '\0';
  }
  return text;
}

}  // namespace roomwise
