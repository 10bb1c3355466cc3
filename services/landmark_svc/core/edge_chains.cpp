#include "services/landmark_svc/core/edge_chains.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace roomwise::landmark {

void ChainLinker::reserve(std::size_t edges, int width_px) {
  chains_.reserve(edges);
  previous_.reserve(edges);
  for (auto& columns : chain_at_column_) columns.reserve(static_cast<std::size_t>(width_px));
  for (auto& columns : measured_at_column_) columns.reserve(static_cast<std::size_t>(width_px));
}

ChainLinker::Reach ChainLinker::reach_of(const ChainParams& params, int width_px, int height_px) {
  return {std::max(1, static_cast<int>(std::lround(params.column_step_max_px * width_px / 640.0))),
          1 + static_cast<int>(std::lround(params.row_gap_max_px * height_px / 480.0))};
}

void ChainLinker::link(const std::vector<EdgePixel>& edges, const DisparityTable& table,
                       int width_px, int height_px, const ChainParams& params) {
  const Reach reach = reach_of(params, width_px, height_px);
  chains_.clear();
  previous_.clear();
  for (auto& columns : chain_at_column_) columns.assign(static_cast<std::size_t>(width_px), -1);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const EdgePixel& edge = edges[i];
    std::int32_t chain = best_chain(edges, edge, table, reach, params);
    if (chain < 0) {
      chain = static_cast<std::int32_t>(chains_.size());
      chains_.push_back({.last_edge = -1, .rows = 0, .side = edge.side});
    }
    EdgeChain& grown = chains_[static_cast<std::size_t>(chain)];
    previous_.push_back(grown.last_edge);
    grown.last_edge = static_cast<std::int32_t>(i);
    ++grown.rows;
    ends_at_column(edge.side)[static_cast<std::size_t>(edge.u_px)] = chain;
  }
}

void ChainLinker::collect(const EdgeChain& chain, const std::vector<EdgePixel>& edges,
                          std::vector<EdgePixel>& pixels) const {
  pixels.clear();
  for (std::int32_t i = chain.last_edge; i >= 0; i = previous_[static_cast<std::size_t>(i)]) {
    pixels.push_back(edges[static_cast<std::size_t>(i)]);
  }
}

double ChainLinker::depth_step_max_m(const DisparityTable& table, const EdgePixel& edge,
                                     const ChainParams& params) {
  const double z_m = table.depth_m(edge.near_steps);
  return params.depth_step_m + params.depth_step_per_m_m2 * z_m * z_m;
}

void ChainLinker::count_measured(const std::vector<EdgePixel>& edges, int width_px) {
  for (auto& columns : measured_at_column_) columns.assign(static_cast<std::size_t>(width_px), {});
  for (const EdgePixel& edge : edges) {
    if (edge.is_open) continue;
    Measured& measured = measured_at_column_[static_cast<std::size_t>(edge.side)]
                                            [static_cast<std::size_t>(edge.u_px)];
    ++measured.rows;
    measured.near_steps_sum += edge.near_steps;
  }
}

int ChainLinker::measured_around(const EdgePixel& edge, const DisparityTable& table,
                                 const Reach& reach, const ChainParams& params) const {
  const auto& columns = measured_at_column_[static_cast<std::size_t>(edge.side)];
  const double most_m = depth_step_max_m(table, edge, params);
  const int first = std::max(0, edge.u_px - reach.columns_px);
  const int last = std::min(static_cast<int>(columns.size()) - 1, edge.u_px + reach.columns_px);
  int rows = 0;
  for (int u = first; u <= last; ++u) {
    const Measured& measured = columns[static_cast<std::size_t>(u)];
    if (measured.rows == 0) continue;
    const double mean_steps = static_cast<double>(measured.near_steps_sum) / measured.rows;
    const double apart_m = std::abs(mean_steps - edge.near_steps) * table.depth_m(1);
    rows += apart_m <= most_m ? measured.rows : 0;
  }
  return rows;
}

void ChainLinker::prove_open_edges(std::vector<EdgePixel>& edges, const DisparityTable& table,
                                   int width_px, int height_px, const ChainParams& params) {
  const Reach reach = reach_of(params, width_px, height_px);
  const double rows_min = params.proof_rows_px * height_px / 480.0;
  count_measured(edges, width_px);
  for (const EdgeChain& chain : chains_) {
    const EdgePixel& lowest = edges[static_cast<std::size_t>(chain.last_edge)];
    if (measured_around(lowest, table, reach, params) < rows_min) continue;
    for (std::int32_t i = chain.last_edge; i >= 0; i = previous_[static_cast<std::size_t>(i)]) {
      edges[static_cast<std::size_t>(i)].is_open = false;
    }
  }
}

std::int32_t ChainLinker::best_chain(const std::vector<EdgePixel>& edges, const EdgePixel& edge,
                                     const DisparityTable& table, const Reach& reach,
                                     const ChainParams& params) const {
  const auto& ends = chain_at_column_[static_cast<std::size_t>(edge.side)];
  const double step_max_m = depth_step_max_m(table, edge, params);
  const int first = std::max(0, edge.u_px - reach.columns_px);
  const int last = std::min(static_cast<int>(ends.size()) - 1, edge.u_px + reach.columns_px);
  std::int32_t best = -1;
  int best_distance = 0;
  for (int u = first; u <= last; ++u) {
    const std::int32_t chain = ends[static_cast<std::size_t>(u)];
    if (chain < 0) continue;
    const EdgePixel& end =
        edges[static_cast<std::size_t>(chains_[static_cast<std::size_t>(chain)].last_edge)];
    const int rows_below = edge.v_px - end.v_px;
    if (end.u_px != u || rows_below < 1 || rows_below > reach.rows_px) continue;
    if (std::abs(table.depth_m(end.near_steps) - table.depth_m(edge.near_steps)) > step_max_m)
      continue;
    const int distance = std::abs(u - edge.u_px) + rows_below;
    if (best < 0 || distance < best_distance) {
      best = chain;
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace roomwise::landmark
