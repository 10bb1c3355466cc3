#include "tests/segment_svc/models/largest_rectangle.h"

#include <algorithm>

namespace roomwise::segment {
namespace {

/// The largest rectangle that stands on a row, by how many pixels of the class stand on it in each
/// column: each column is the lowest of one candidate.
TrainingRectangle largest_on_row(const std::vector<int>& standing, int row, int label) {
  TrainingRectangle best{.label = label};
  const int width = static_cast<int>(standing.size());
  for (int u = 0; u < width; ++u) {
    int lowest = standing[static_cast<std::size_t>(u)];
    for (int right = u; right < width && lowest > 0; ++right) {
      lowest = std::min(lowest, standing[static_cast<std::size_t>(right)]);
      const int across = right - u + 1;
      if (lowest * across > best.width_px * best.height_px) {
        best = {.label = label,
                .left_px = u,
                .top_px = row - lowest + 1,
                .width_px = across,
                .height_px = lowest};
      }
    }
  }
  return best;
}

}  // namespace

TrainingRectangle largest_rectangle(const std::vector<std::uint8_t>& labels, int width_px,
                                    int height_px, int label) {
  TrainingRectangle best{.label = label};
  std::vector<int> standing(static_cast<std::size_t>(width_px), 0);
  for (int v = 0; v < height_px; ++v) {
    for (std::size_t u = 0; u < standing.size(); ++u) {
      const std::size_t pixel = static_cast<std::size_t>(v) * standing.size() + u;
      standing[u] = labels[pixel] == label ? standing[u] + 1 : 0;
    }
    const TrainingRectangle here = largest_on_row(standing, v, label);
    if (here.width_px * here.height_px > best.width_px * best.height_px) best = here;
  }
  return best;
}

}  // namespace roomwise::segment
