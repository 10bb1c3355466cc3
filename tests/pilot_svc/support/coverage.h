#pragma once
#include <Eigen/Core>
#include <vector>

#include "services/simulator/core/ground_plan.h"

namespace roomwise::pilot {

/// How much of the floor that a robot can get to from its start it has rolled over: squares of
/// 10 cm whose centre lies under its body (radius 0.17 m) at some time.
class Coverage {
 public:
  Coverage(const simulator::GroundPlan& plan, const Eigen::Vector2d& start_m);

  void visit(const Eigen::Vector2d& p_m);
  double ratio() const;
  double floor_m2() const;

 private:
  static constexpr double kSquare_m = 0.1;
  static constexpr int kSide = 400;  // 40 m, the start in the middle

  Eigen::Vector2d center_m(int index) const;
  int index_at(const Eigen::Vector2d& p_m) const;
  void mark(std::vector<bool>& squares, const Eigen::Vector2d& p_m) const;

  Eigen::Vector2d origin_m_;
  std::vector<bool> reachable_;
  std::vector<bool> covered_;
};

}  // namespace roomwise::pilot
