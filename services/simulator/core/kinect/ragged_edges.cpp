#include "services/simulator/core/kinect/ragged_edges.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/multiversion.h"
#include "services/simulator/core/kinect/pixel_hash.h"

namespace roomwise::simulator {
namespace {

constexpr int kPatch_px = 5;

/// 1 where the four neighbours `reach` away differ by `jump` or more from one another. Along row
/// `here`; `above` and `below` are rows of the same image. Returns whether there is any.
ROOMWISE_MULTIVERSION
int mark_jumps(const float* here, const float* above, const float* below, int reach, int width,
               float jump, std::uint8_t* marks) {
  int any = 0;
  for (int u = reach; u < width - reach; ++u) {
    const float across = std::abs(here[u + reach] - here[u - reach]);
    const float along = std::abs(below[u] - above[u]);
    const int mark = static_cast<int>(across >= jump) | static_cast<int>(along >= jump);
    marks[u] = static_cast<std::uint8_t>(mark);
    any |= mark;
  }
  return any;
}

/// Shift of the patch that pixel (u, v) belongs to: patches of one row of them begin anywhere.
std::uint32_t patch_hash(int u, int v, std::uint32_t key) {
  const auto patch_row = static_cast<std::uint32_t>(v / kPatch_px);
  const std::uint32_t row_hash = hash32(key + patch_row);
  const std::uint32_t column = (static_cast<std::uint32_t>(u) + row_hash % kPatch_px) / kPatch_px;
  return hash32(row_hash + column);
}

}  // namespace

void RaggedEdges::resize(int width_px, int height_px, int reach_px) {
  if (reach_px < 0 || reach_px > 4) throw std::invalid_argument("ragged edges: reach");
  width_px_ = width_px;
  height_px_ = height_px;
  reach_px_ = reach_px;
  beside_jump_.assign(static_cast<std::size_t>(width_px), 0);
}

bool RaggedEdges::find_jumps(const std::vector<float>& image, int v, float jump) {
  const auto row = [&](int at) {
    return image.data() +
           static_cast<std::ptrdiff_t>(std::clamp(at, 0, height_px_ - 1)) * width_px_;
  };
  return mark_jumps(row(v), row(v - reach_px_), row(v + reach_px_), reach_px_, width_px_, jump,
                    beside_jump_.data()) != 0;
}

void RaggedEdges::copy_row(const std::vector<float>& image, int v, float jump, std::uint32_t key,
                           float* row) {
  const float* here = image.data() + static_cast<std::ptrdiff_t>(v) * width_px_;
  std::copy_n(here, width_px_, row);
  if (reach_px_ == 0 || !find_jumps(image, v, jump)) return;
  const auto span = static_cast<std::uint32_t>(2 * reach_px_ + 1);
  for (int u = reach_px_; u < width_px_ - reach_px_; ++u) {
    if (beside_jump_[static_cast<std::size_t>(u)] == 0) continue;
    const std::uint32_t hash = patch_hash(u, v, key);
    const int du = static_cast<int>((hash & 0xffff) % span) - reach_px_;
    const int dv = static_cast<int>((hash >> 16) % span) - reach_px_;
    const int from_v = std::clamp(v + dv, 0, height_px_ - 1);
    row[u] = image[static_cast<std::size_t>(from_v) * static_cast<std::size_t>(width_px_) +
                   static_cast<std::size_t>(u + du)];
  }
}

}  // namespace roomwise::simulator
