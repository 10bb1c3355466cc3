#include "tests/pilot_svc/support/coverage.h"

#include <algorithm>
#include <cmath>

namespace roomwise::pilot {
namespace {

constexpr double kBody_m = 0.17;

}  // namespace

Coverage::Coverage(const simulator::GroundPlan& plan, const Eigen::Vector2d& start_m)
    : origin_m_(start_m - Eigen::Vector2d::Constant(0.5 * kSide * kSquare_m)),
      reachable_(kSide * kSide),
      covered_(kSide * kSide) {
  std::vector<bool> seen(kSide * kSide);
  std::vector<int> open{index_at(start_m)};
  while (!open.empty()) {
    const int index = open.back();
    open.pop_back();
    const int column = index % kSide;
    const bool is_rim =
        column == 0 || column == kSide - 1 || index < kSide || index >= kSide * (kSide - 1);
    if (seen[static_cast<std::size_t>(index)] || is_rim) continue;
    seen[static_cast<std::size_t>(index)] = true;
    if (simulator::clearance_m(plan, center_m(index)) < kBody_m) continue;
    mark(reachable_, center_m(index));
    for (const int next : {index - 1, index + 1, index - kSide, index + kSide})
      open.push_back(next);
  }
}

void Coverage::visit(const Eigen::Vector2d& p_m) { mark(covered_, p_m); }

double Coverage::ratio() const {
  int both = 0;
  for (std::size_t i = 0; i < reachable_.size(); ++i) both += reachable_[i] && covered_[i] ? 1 : 0;
  return both * kSquare_m * kSquare_m / floor_m2();
}

double Coverage::floor_m2() const {
  return static_cast<double>(std::count(reachable_.begin(), reachable_.end(), true)) * kSquare_m *
         kSquare_m;
}

Eigen::Vector2d Coverage::center_m(int index) const {
  return origin_m_ + kSquare_m * Eigen::Vector2d(index % kSide + 0.5, index / kSide + 0.5);
}

int Coverage::index_at(const Eigen::Vector2d& p_m) const {
  const Eigen::Vector2d square = (p_m - origin_m_) / kSquare_m;
  const auto within = [](double at) { return std::clamp(static_cast<int>(at), 0, kSide - 1); };
  return within(square.y()) * kSide + within(square.x());
}

void Coverage::mark(std::vector<bool>& squares, const Eigen::Vector2d& p_m) const {
  for (int dy = -2; dy <= 2; ++dy) {
    for (int dx = -2; dx <= 2; ++dx) {
      const int index = index_at(p_m + kSquare_m * Eigen::Vector2d(dx, dy));
      if ((center_m(index) - p_m).norm() < kBody_m) squares[static_cast<std::size_t>(index)] = true;
    }
  }
}

}  // namespace roomwise::pilot
