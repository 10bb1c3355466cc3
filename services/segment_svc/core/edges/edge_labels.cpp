#include "services/segment_svc/core/edges/edge_labels.h"

#include <algorithm>
#include <array>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "services/segment_svc/core/color/grey_gaussians.h"
#include "services/segment_svc/core/edges/edge_relaxation.h"

namespace roomwise::segment {
namespace {

constexpr int kWidth_px = 160;
constexpr double kFull_levels = 60.0;
constexpr int kRounds = 10;
constexpr float kRelaxStep = 0.1F;
constexpr float kEdge = 0.5F;
constexpr std::size_t kCracksMin = 8;
constexpr float kGapCost = 8.0F;

/// Smaller, averaged and smoothed: noise and texture are no borders.
cv::Mat3b reduced(const ColorImage& color) {
  const cv::Mat3b whole(color.height_px, color.width_px,
                        reinterpret_cast<cv::Vec3b*>(const_cast<std::uint8_t*>(color.rgb.data())));
  const int height_px = std::max(1, color.height_px * kWidth_px / color.width_px);
  cv::Mat3b small;
  cv::resize(whole, small, {kWidth_px, height_px}, 0, 0, cv::INTER_AREA);
  cv::medianBlur(small, small, 3);
  return small;
}

std::vector<std::uint8_t> grey_of(const cv::Mat3b& rgb) {
  std::vector<std::uint8_t> grey;
  for (const cv::Vec3b& pixel : rgb) grey.push_back(grey_level(pixel[0], pixel[1], pixel[2]));
  return grey;
}

struct ColorSum {
  std::array<std::int64_t, 3> levels{};
  std::int64_t pixels = 0;

  void add(const cv::Vec3b& rgb) {
    for (int i = 0; i < 3; ++i) levels[static_cast<std::size_t>(i)] += rgb[i];
    ++pixels;
  }
  std::array<std::uint8_t, 3> mean() const {
    const auto level = [this](std::int64_t sum) { return static_cast<std::uint8_t>(sum / pixels); };
    return {level(levels[0]), level(levels[1]), level(levels[2])};
  }
};

std::vector<std::uint8_t> labels_of_regions(const cv::Mat3b& rgb, const std::vector<int>& regions,
                                            const ColorTable& table) {
  std::vector<ColorSum> sums(
      static_cast<std::size_t>(1 + *std::max_element(regions.begin(), regions.end())));
  auto region = regions.begin();
  for (const cv::Vec3b& pixel : rgb) sums[static_cast<std::size_t>(*region++)].add(pixel);
  std::vector<std::uint8_t> labels;
  for (const ColorSum& sum : sums) labels.push_back(table.classify(sum.mean().data()));
  return labels;
}

/// Whether a crack is part of a border.
struct Barriers {
  std::vector<char> right, down;

  Barriers(const CrackEdges& edges, const std::vector<Border>& borders)
      : right(edges.right.size(), 0), down(edges.right.size(), 0) {
    for (const Border& border : borders) {
      for (std::size_t i = 1; i < border.size(); ++i) {
        const auto [from, to] = std::minmax(border[i - 1], border[i]);
        (to - from == 1 ? right : down)[static_cast<std::size_t>(from)] = 1;
      }
    }
  }
};

}  // namespace

std::vector<int> regions_between(const CrackEdges& edges, const std::vector<Border>& borders) {
  const Barriers barriers(edges, borders);
  const int width = edges.width_px;
  std::vector<int> regions(static_cast<std::size_t>(width * edges.height_px), -1);
  std::vector<int> open;
  int next = 0;
  for (int start = 0; start < width * edges.height_px; ++start) {
    const auto join = [&](int pixel) {
      int& region = regions[static_cast<std::size_t>(pixel)];
      if (region >= 0) return;
      region = next;
      open.push_back(pixel);
    };
    if (regions[static_cast<std::size_t>(start)] >= 0) continue;
    join(start);
    while (!open.empty()) {
      const int pixel = open.back();
      open.pop_back();
      const int u = pixel % width;
      const int v = pixel / width;
      const auto crosses = [](const std::vector<char>& cracks, int corner) {
        return cracks[static_cast<std::size_t>(corner)] != 0;
      };
      if (u > 0 && !crosses(barriers.down, edges.corner(u, v))) join(pixel - 1);
      if (u + 1 < width && !crosses(barriers.down, edges.corner(u + 1, v))) join(pixel + 1);
      if (v > 0 && !crosses(barriers.right, edges.corner(u, v))) join(pixel - width);
      if (v + 1 < edges.height_px && !crosses(barriers.right, edges.corner(u, v + 1)))
        join(pixel + width);
    }
    ++next;
  }
  return regions;
}

std::vector<std::uint8_t> label_by_edges(const ColorImage& color, const ColorTable& table,
                                         int width_px, int height_px) {
  const cv::Mat3b rgb = reduced(color);
  CrackEdges edges = find_cracks(grey_of(rgb), rgb.cols, rgb.rows, kFull_levels);
  relax_edges(edges, kRounds, kRelaxStep);
  std::vector<Border> borders = trace_borders(edges, kEdge, kCracksMin);
  close_gaps(edges, kGapCost, borders);
  const std::vector<int> regions = regions_between(edges, borders);
  const std::vector<std::uint8_t> label_of = labels_of_regions(rgb, regions, table);
  std::vector<std::uint8_t> labels;
  labels.reserve(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < width_px; ++u) {
      const int pixel = v * rgb.rows / height_px * rgb.cols + u * rgb.cols / width_px;
      labels.push_back(
          label_of[static_cast<std::size_t>(regions[static_cast<std::size_t>(pixel)])]);
    }
  }
  return labels;
}

}  // namespace roomwise::segment
