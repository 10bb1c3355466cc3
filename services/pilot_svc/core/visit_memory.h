#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "common/time.h"

namespace roomwise::pilot {

/// When the robot was last where, in squares of half a metre of the odom frame; a torus of 32 m.
class VisitMemory {
 public:
  VisitMemory() : cells_(kSide * kSide) {}

  void forget();
  void visit(Time now, const Eigen::Vector2d& p_odom_m);

  /// 1: visited just now, falling by a factor e every `fades_s`; 0: never. A fresh visit to a
  /// neighbouring square does not count.
  double freshness(Time now, const Eigen::Vector2d& p_odom_m, double fades_s) const;

 private:
  static constexpr int kSide = 64;
  struct Cell {
    std::int32_t column = INT32_MIN;
    std::int32_t row = INT32_MIN;
    Time visited{};
  };
  static Cell cell_at(Time now, const Eigen::Vector2d& p_odom_m);
  static std::size_t slot_of(const Cell& cell);

  std::vector<Cell> cells_;
};

}  // namespace roomwise::pilot
