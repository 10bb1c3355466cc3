#include "services/landmark_svc/core/jump_edges.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <optional>

#include "common/multiversion.h"

namespace roomwise::landmark {
namespace {

constexpr int kWord = 8;

/// Sets changes[u] where columns u-1 and u differ by at least `jump`, or one is good and the other
/// bad: the only places where an edge can be. 16-bit arithmetic without branches, so that it runs
/// many columns at a time.
ROOMWISE_MULTIVERSION
void mark_changes(const std::uint16_t* row, int width, std::uint16_t smallest_good,
                  std::uint16_t good_span, std::uint16_t jump, std::uint8_t* changes) {
  changes[0] = 0;
  for (int u = 1; u < width; ++u) {
    const auto above_a = static_cast<std::uint16_t>(row[u - 1] - smallest_good);
    const auto above_b = static_cast<std::uint16_t>(row[u] - smallest_good);
    const std::uint16_t a = above_a <= good_span ? row[u - 1] : std::uint16_t{0};
    const std::uint16_t b = above_b <= good_span ? row[u] : std::uint16_t{0};
    const auto step = static_cast<std::uint16_t>(std::max(a, b) - std::min(a, b));
    changes[u] = static_cast<std::uint8_t>(step >= jump ? 1 : 0);
  }
}

struct Limits {
  int jump_parts;
  int jump_steps;
  int gap_max_px;
  int gap_slope_parts;
  int near_run_px;
  int far_run_px;
  int near_steps_min;
  int near_steps_max;
  bool finds_open;
};

/// Columns of a row.
struct Edge {
  int near;
  int far;
  int near_run_px;
  bool is_open;
};

/// Judges the changes of one row.
class RowJudge {
 public:
  RowJudge(const std::uint16_t* row, int width, const DisparityTable& table, const Limits& limits)
      : row_(row), width_(width), table_(table), limits_(limits) {}

  /// Tells of a change between columns u-1 and u, in ascending order.
  template <class Found>
  void change_at(int u, RejectCounts& rejected, Found found) {
    const bool good_before = table_.is_good(row_[u - 1]);
    const bool good_here = table_.is_good(row_[u]);
    if (good_before && !good_here) {
      last_good_ = u - 1;
      open_far_ = far_beyond(u, 1);
    }
    if (!good_here) return;
    const int before = good_before ? u - 1 : last_good_;
    const std::optional<Edge> edge = edge_between(before, u, rejected);
    if (!edge || edge->near != before) end_open(found);
    open_far_ = -1;
    if (edge) {
      found(*edge);
    } else if (const int far = good_before ? -1 : far_beyond(u - 1, -1); is_open_edge(u, far)) {
      found(Edge{u, far, near_run_px(u, 1), true});
    }
  }

  /// Tells of the row's end.
  template <class Found>
  void end(Found found) {
    end_open(found);
  }

 private:
  int parts(int u) const {
    return table_.is_good(row_[u]) ? table_.parts(row_[u]) : table_.parts_beyond(row_[u]);
  }
  bool is_measured(int u) const { return table_.is_good(row_[u]) || table_.is_beyond(row_[u]); }

  std::optional<Edge> edge_between(int before, int u, RejectCounts& rejected) const {
    if (before < 0 || u - before > limits_.gap_max_px + 1 || !is_jump(before, u)) {
      return std::nullopt;
    }
    const bool here_is_near = row_[u] < row_[before];
    return judge(here_is_near ? u : before, here_is_near ? before : u, rejected);
  }

  /// The first reading beyond from column u on, holes up to the largest gap passed over; -1: none.
  int far_beyond(int u, int outward) const {
    if (!limits_.finds_open) return -1;
    for (int k = 0; k <= limits_.gap_max_px; ++k, u += outward) {
      if (!inside(u) || table_.is_good(row_[u])) return -1;
      if (table_.is_beyond(row_[u])) return u;
    }
    return -1;
  }

  bool is_open_edge(int near, int far) const {
    if (far < 0 || row_[near] < limits_.near_steps_min || row_[near] > limits_.near_steps_max) {
      return false;
    }
    const int inward = near > far ? 1 : -1;
    const int near_run = near_run_px(near, inward);
    return near_run >= limits_.near_run_px && stays_far(near, far, -inward) &&
           !is_explained_by_slope(near, far, inward, near_run);
  }

  template <class Found>
  void end_open(Found found) {
    if (is_open_edge(last_good_, open_far_)) {
      found(Edge{last_good_, open_far_, near_run_px(last_good_, -1), true});
    }
    open_far_ = -1;
  }

  bool inside(int u) const { return u >= 0 && u < width_; }
  bool is_jump(int a, int b) const {
    return std::abs(parts(a) - parts(b)) >= limits_.jump_parts &&
           std::abs(row_[a] - row_[b]) >= limits_.jump_steps;
  }

  std::optional<Edge> judge(int near, int far, RejectCounts& rejected) const {
    const int inward = near > far ? 1 : -1;
    const int near_run = near_run_px(near, inward);
    if (row_[near] < limits_.near_steps_min || row_[near] > limits_.near_steps_max) {
      rejected.add(RejectReason::kEdgeOutOfRange);
    } else if (near_run < limits_.near_run_px) {
      rejected.add(RejectReason::kEdgeNearTooShort);
    } else if (!stays_far(near, far, -inward)) {
      rejected.add(RejectReason::kEdgeFarTooShort);
    } else if (is_explained_by_slope(near, far, inward, near_run)) {
      rejected.add(RejectReason::kEdgeOnSlope);
    } else {
      return Edge{near, far, near_run, false};
    }
    return std::nullopt;
  }

  int near_run_px(int near, int inward) const {
    int run = 1;
    while (run < kNearRunMax_px) {
      const int next = near + inward * run;
      if (!inside(next) || !table_.is_good(row_[next]) || is_jump(next - inward, next)) break;
      ++run;
    }
    return run;
  }

  bool stays_far(int near, int far, int outward) const {
    for (int k = 1; k < limits_.far_run_px; ++k) {
      const int u = far + outward * k;
      if (!inside(u) || !is_measured(u)) return false;
      if (row_[u] < row_[near] || !is_jump(near, u)) return false;
    }
    return true;
  }

  bool is_explained_by_slope(int near, int far, int inward, int near_run) const {
    const int gap = std::abs(far - near);
    const int run = std::max(near_run - 1, 1);
    const int slope_run = near_run > 1 ? parts(near) - parts(near + inward * run) : 0;
    // |jump - slope * gap| < jump_parts + gap_slope * (gap - 1), times `run` to stay in integers.
    const int unexplained = std::abs((parts(far) - parts(near)) * run - slope_run * gap);
    return unexplained < (limits_.jump_parts + limits_.gap_slope_parts * (gap - 1)) * run;
  }

  const std::uint16_t* row_;
  int width_;
  const DisparityTable& table_;
  const Limits& limits_;
  int last_good_ = -1;
  int open_far_ = -1;  ///< what lies beyond last_good_, if that is a reading beyond
};

/// Calls `change(u)` for each marked column, skipping eight unmarked ones at a time.
template <class Change>
void for_each_change(const std::uint8_t* changes, int width, Change change) {
  for (int first = 0; first < width; first += kWord) {
    std::uint64_t word;
    std::memcpy(&word, changes + first, sizeof word);
    for (; word != 0; word &= word - 1) change(first + std::countr_zero(word) / 8);
  }
}

Limits limits_of(const JumpEdgeParams& params, const DisparityTable& table, int width_px) {
  const auto parts = [](double quanta) {
    return static_cast<int>(std::lround(quanta * DisparityTable::kPartsPerQuantum));
  };
  constexpr int kShortestRun_px = 4;
  const int near_run =
      std::min(params.near_run_px, std::max(kShortestRun_px, params.near_run_px * width_px / 640));
  return {.jump_parts = parts(params.jump_quanta),
          .jump_steps = table.steps_from_m(params.jump_m),
          .gap_max_px = static_cast<int>(std::lround(params.gap_max_px * width_px / 640.0)),
          .gap_slope_parts = parts(params.gap_slope_quanta_px),
          .near_run_px = near_run,
          .far_run_px = params.far_run_px,
          .near_steps_min = table.steps_from_m(params.range_min_m),
          .near_steps_max = table.steps_from_m(params.range_max_m),
          .finds_open = params.finds_open};
}

}  // namespace

void JumpEdgeFinder::find(const DepthImage& depth, const DisparityTable& table,
                          const PixelRectangle& region, const JumpEdgeParams& params,
                          std::vector<EdgePixel>& edges, RejectCounts& rejected) {
  const int width = region.width_px();
  const int good_span = table.largest_good_step() - table.smallest_good_step();
  if (region.empty() || good_span < 0) return;
  const Limits limits = limits_of(params, table, depth.width_px);
  // No larger than any good reading, so that every change between good and bad is marked.
  const int marked_step = std::min(limits.jump_steps, table.smallest_good_step());
  changes_.resize(static_cast<std::size_t>(width + kWord));
  std::fill(changes_.end() - kWord, changes_.end(), std::uint8_t{0});
  for (int v = region.v_begin_px; v < region.v_end_px; ++v) {
    const std::uint16_t* row =
        depth.steps.data() +
        static_cast<std::size_t>(v) * static_cast<std::size_t>(depth.width_px) + region.u_begin_px;
    mark_changes(row, width, static_cast<std::uint16_t>(table.smallest_good_step()),
                 static_cast<std::uint16_t>(good_span), static_cast<std::uint16_t>(marked_step),
                 changes_.data());
    RowJudge judge(row, width, table, limits);
    const auto found = [&](const Edge& edge) {
      edges.push_back({.u_px = static_cast<std::int16_t>(region.u_begin_px + edge.near),
                       .v_px = static_cast<std::int16_t>(v),
                       .near_steps = row[edge.near],
                       .far_steps = row[edge.far],
                       .gap_px = static_cast<std::uint16_t>(std::abs(edge.far - edge.near)),
                       .near_run_px = static_cast<std::uint8_t>(edge.near_run_px),
                       .side = edge.near > edge.far ? EdgeSide::kLeft : EdgeSide::kRight,
                       .is_open = edge.is_open});
    };
    for_each_change(changes_.data(), width, [&](int u) { judge.change_at(u, rejected, found); });
    judge.end(found);
  }
}

}  // namespace roomwise::landmark
