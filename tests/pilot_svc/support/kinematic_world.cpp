#include "tests/pilot_svc/support/kinematic_world.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "services/simulator/core/contact.h"
#include "services/simulator/scenario/scenario.h"

namespace roomwise::pilot {
namespace {

constexpr double kBase_m = 0.235;
constexpr double kRadius_m = 0.17;
constexpr double kDegree_rad = std::numbers::pi / 180.0;
constexpr int kBins = 91;
constexpr double kViewHalf_rad = 28.5 * kDegree_rad;
constexpr double kFloorSeenFrom_m = 0.75;
constexpr double kFloorNeeded_m = 0.25;
constexpr double kNearestReading_m = 0.45;
constexpr double kRangeMax_m = 4.5;
constexpr double kCell_m = 0.05;
constexpr double kSightHeight_m = 0.6;

Eigen::Vector2d unit(double heading_rad) { return {std::cos(heading_rad), std::sin(heading_rad)}; }

}  // namespace

simulator::Scene scenario_scene(const std::string& name) {
  return simulator::load_scenario(simulator::find_scenario(name, ROOMWISE_SCENARIO_FOLDER)).scene;
}

KinematicWorld::KinematicWorld(simulator::Scene scene, const ViewNoise& noise, unsigned seed)
    : scene_(std::move(scene)),
      noise_(noise),
      random_(seed),
      body_plan_(simulator::ground_plan(scene_, 0.0)),
      sight_plan_(simulator::ground_plan(scene_, 0.0, kSightHeight_m)),
      motion_({}, kBase_m, scene_.start, std::mt19937_64(seed + 1)) {}

double KinematicWorld::clearance_m() const {
  return simulator::clearance_m(body_plan_, T_world_robot().position_m()) - kRadius_m;
}

/// True if the body touches something nearer than now on the way so far ahead.
bool KinematicWorld::meets(double way_m) const {
  const double gap_now_m = clearance_m();
  for (const double share : {0.25, 0.5, 0.75, 1.0}) {
    const Eigen::Vector2d at_m =
        T_world_robot().position_m() + share * way_m * unit(T_world_robot().heading_rad);
    const double gap_m = simulator::clearance_m(body_plan_, at_m) - kRadius_m;
    if (gap_m <= 0.0 && gap_m <= gap_now_m) return true;
  }
  return false;
}

/// Slower the nearer the rim would come to anything within the way it needs to stop, and no faster
/// a change than safety_svc grants.
Motion KinematicWorld::grant(const Motion& asked) const {
  Motion granted = asked;
  const double rate_mps = 0.5 * kStep_s;
  granted.speed_mps = std::clamp(asked.speed_mps, granted_.speed_mps - 2.0 * rate_mps,
                                 granted_.speed_mps + rate_mps);
  const double reaction_s = scene_.walkers.empty() ? 0.3 : 1.2;  // they come nearer meanwhile
  const double sign = granted.speed_mps < 0.0 ? -1.0 : 1.0;
  while (std::abs(granted.speed_mps) > 0.0 &&
         meets(sign * (reaction_s * std::abs(granted.speed_mps) + 0.03))) {
    granted.speed_mps = std::abs(granted.speed_mps) < 0.02 ? 0.0 : 0.7 * granted.speed_mps;
  }
  return granted;
}

void KinematicWorld::step(const Motion& asked) {
  time_s_ += kStep_s;
  if (!scene_.walkers.empty()) {
    body_plan_ = simulator::ground_plan(scene_, time_s_);
    sight_plan_ = simulator::ground_plan(scene_, time_s_, kSightHeight_m);
  }
  granted_ = grant(asked);
  simulator::keep_near(body_plan_, T_world_robot().position_m(), 0.5, near_plan_);
  const double half_mps = 0.5 * kBase_m * granted_.turn_rate_radps;
  const auto before = motion_.wheels();
  for (int i = 0; i < 10; ++i) {
    motion_.step(near_plan_, {granted_.speed_mps - half_mps, granted_.speed_mps + half_mps},
                 kStep_s / 10);
  }
  const double left_m = motion_.wheels().left.turned_m - before.left.turned_m;
  const double right_m = motion_.wheels().right.turned_m - before.right.turned_m;
  const double turn_rad = (right_m - left_m) / kBase_m;
  const Eigen::Vector2d way_m = 0.5 * (left_m + right_m) * unit(0.5 * turn_rad);
  T_odom_robot_ = compose(T_odom_robot_, {way_m.x(), way_m.y(), turn_rad});
  const Eigen::Vector2d velocity_mps = granted_.speed_mps * unit(T_world_robot().heading_rad);
  const auto& touches = motion_.touches();
  const bool runs_into = std::any_of(touches.begin(), touches.end(), [&](const auto& touch) {
    return touch.direction.dot(velocity_mps) > 0.1;
  });
  if (runs_into && !runs_into_) ++contacts_;
  runs_into_ = runs_into;
}

double KinematicWorld::seen_range_m(double bearing_rad) {
  const Pose2& T = T_world_robot();
  double range_m = simulator::free_way_m(sight_plan_, T.position_m(),
                                         unit(T.heading_rad + bearing_rad), kRangeMax_m);
  if (noise_.range_sigma_ratio > 0.0) {
    range_m *= 1.0 + noise_.range_sigma_ratio * std::normal_distribution<double>()(random_);
  }
  if (std::bernoulli_distribution(noise_.dropout_probability)(random_)) {
    range_m *= std::uniform_real_distribution<double>(0.3, 1.0)(random_);
  }
  return range_m;
}

/// Little floor before something is not told from it, and what is too near is not measured.
void KinematicWorld::see(double bearing_rad) {
  const double range_m = seen_range_m(bearing_rad);
  const double cell_m = std::floor(range_m / kCell_m) * kCell_m;
  const bool shows_floor = range_m > kFloorSeenFrom_m / std::cos(bearing_rad) + kFloorNeeded_m;
  const bool is_measured = range_m > kNearestReading_m && range_m < kRangeMax_m;
  free_range_m_.push_back(shows_floor ? cell_m : 0.0);
  obstacle_range_m_.push_back(is_measured ? cell_m + 0.5 * kCell_m : 0.0);
  unknown_ratio_.push_back(0.05);
}

FreeView KinematicWorld::view() {
  free_range_m_.clear();
  obstacle_range_m_.clear();
  unknown_ratio_.clear();
  for (int k = 0; k < kBins; ++k) {
    const double bearing_rad = (k - kBins / 2) * kDegree_rad;
    if (std::abs(bearing_rad) < kViewHalf_rad) {
      see(bearing_rad);
      continue;
    }
    free_range_m_.push_back(0.0);
    obstacle_range_m_.push_back(0.0);
    unknown_ratio_.push_back(1.0);
  }
  return {-(kBins / 2) * kDegree_rad, kDegree_rad, free_range_m_, unknown_ratio_,
          obstacle_range_m_};
}

}  // namespace roomwise::pilot
