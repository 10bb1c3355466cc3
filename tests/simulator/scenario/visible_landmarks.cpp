#include "tests/simulator/scenario/visible_landmarks.h"

#include <algorithm>
#include <cmath>

namespace roomwise::simulator {
namespace {

double turn_of(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

bool cross_each_other(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
                      const Eigen::Vector2d& d) {
  return turn_of(a, b, c) * turn_of(a, b, d) < 0.0 && turn_of(c, d, a) * turn_of(c, d, b) < 0.0;
}

bool hides(const Block& block, const Eigen::Vector2d& eye_m, const Eigen::Vector2d& target_m) {
  for (std::size_t i = 0; i < block.corners_m.size(); ++i) {
    const Eigen::Vector2d& next = block.corners_m[(i + 1) % block.corners_m.size()];
    if (cross_each_other(eye_m, target_m, block.corners_m[i], next)) return true;
  }
  return false;
}

bool in_view(const Pose2& T_world_robot, const Eigen::Vector2d& p_m) {
  const Eigen::Vector2d seen = transform(inverse(T_world_robot), p_m);
  return seen.norm() > 0.6 && seen.norm() < 3.8 && std::abs(std::atan2(seen.y(), seen.x())) < 0.49;
}

}  // namespace

std::vector<SceneLandmark> visible_landmarks(const Scene& scene, const Pose2& T_world_robot) {
  std::vector<SceneLandmark> visible;
  const Eigen::Vector2d eye_m = T_world_robot.position_m();
  for (const SceneLandmark& landmark : scene.landmarks) {
    if (!in_view(T_world_robot, landmark.position_m) || landmark.low_m > 1.0) continue;
    const double height_m = (landmark.low_m + std::min(1.0, landmark.high_m)) / 2;
    const Eigen::Vector2d before_m =
        landmark.position_m + 0.05 * (eye_m - landmark.position_m).normalized();
    const bool hidden =
        std::any_of(scene.blocks.begin(), scene.blocks.end(), [&](const Block& block) {
          return block.low_m < height_m && height_m < block.high_m && hides(block, eye_m, before_m);
        });
    if (!hidden) visible.push_back(landmark);
  }
  return visible;
}

}  // namespace roomwise::simulator
