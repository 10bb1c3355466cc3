#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace roomwise {

/// Times of one kind [s], and what there is to say of them.
class Histogram {
 public:
  void add(double time_s) { times_s_.push_back(time_s); }
  std::size_t count() const { return times_s_.size(); }

  /// The smallest time that this share of all does not exceed [s]. There must be one.
  double quantile_s(double share) const {
    std::vector<double> sorted = times_s_;
    std::sort(sorted.begin(), sorted.end());
    const double rank = std::ceil(share * static_cast<double>(sorted.size()));
    return sorted[static_cast<std::size_t>(std::max(rank, 1.0)) - 1];
  }

  /// A line of figures, then a bar for every `step_s`.
  std::string text(const std::string& title, double step_s) const {
    std::string all = fmt::format("{}: n {}", title, count());
    if (times_s_.empty()) return all + "\n";
    all += fmt::format(", p50 {:.1f} ms, p90 {:.1f} ms, p99 {:.1f} ms, longest {:.1f} ms\n",
                       1e3 * quantile_s(0.5), 1e3 * quantile_s(0.9), 1e3 * quantile_s(0.99),
                       1e3 * quantile_s(1.0));
    std::vector<std::size_t> bars(static_cast<std::size_t>(quantile_s(1.0) / step_s) + 1);
    for (const double time_s : times_s_) {
      ++bars[static_cast<std::size_t>(std::max(time_s, 0.0) / step_s)];
    }
    const std::size_t tallest = *std::max_element(bars.begin(), bars.end());
    for (std::size_t i = 0; i < bars.size(); ++i) {
      if (bars[i] == 0) continue;
      all += fmt::format("  {:5.0f} ms {:6} {}\n", 1e3 * step_s * static_cast<double>(i), bars[i],
                         std::string((60 * bars[i] + tallest - 1) / tallest, '#'));
    }
    return all;
  }

 private:
  std::vector<double> times_s_;
};

}  // namespace roomwise
