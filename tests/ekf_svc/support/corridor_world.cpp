#include "tests/ekf_svc/support/corridor_world.h"

#include <cmath>

namespace roomwise::ekf {
namespace {

constexpr double kCornerRadius_m = 0.6;

/// `along_m` from the square's corner number `side`, the first at the origin; the left is inside.
Pose2 straight(int side, double along_m, double side_m) {
  const Pose2 corners[] = {{0.0, 0.0, 0.0},
                           {side_m, 0.0, 0.5 * std::numbers::pi},
                           {side_m, side_m, -std::numbers::pi},
                           {0.0, side_m, -0.5 * std::numbers::pi}};
  return compose(corners[side % 4], {along_m, 0.0, 0.0});
}

}  // namespace

CorridorWorld::CorridorWorld(const CorridorSettings& settings, std::uint64_t seed)
    : settings_(settings), engine_(seed) {
  const int own_sides = settings.looks_the_same_turned_round ? 2 : 4;
  for (int side = 0; side < own_sides; ++side) line_with_landmarks(side);
  if (settings.looks_the_same_turned_round) {
    const Pose2 turned_round{settings.side_m, settings.side_m, std::numbers::pi};
    const std::size_t count = landmarks_.size();
    for (std::size_t l = 0; l < count; ++l) {
      landmarks_.push_back(transform(turned_round, landmarks_[l]));
      kinds_.push_back(kinds_[l]);
    }
  }
  truth_ = course(0.0);
}

void CorridorWorld::line_with_landmarks(int side) {
  for (const double left_m : {settings_.half_width_m, -settings_.half_width_m}) {
    const double from_m = left_m > 0.0 ? settings_.half_width_m : -settings_.half_width_m;
    for (double at = from_m; at < settings_.side_m - from_m; at += settings_.spacing_m) {
      const double shift_m = settings_.spacing_m / 3.0 * (uniform_(engine_) - 0.5);
      const Pose2 wall = straight(side, at + shift_m, settings_.side_m);
      landmarks_.push_back(transform(wall, {0.0, left_m + 0.1 * (uniform_(engine_) - 0.5)}));
      kinds_.push_back(static_cast<std::int8_t>(uniform_(engine_) * settings_.classes));
    }
  }
}

double CorridorWorld::lap_m() const {
  return 4.0 * (settings_.side_m + (0.5 * std::numbers::pi - 2.0) * kCornerRadius_m);
}

/// Straight on, then round the corner on a circle, four times.
Pose2 CorridorWorld::course(double way_m) const {
  const double quarter_m = 0.25 * lap_m();
  const int side = static_cast<int>(way_m / quarter_m);
  const double in_side_m = way_m - side * quarter_m;
  const double straight_m = settings_.side_m - 2.0 * kCornerRadius_m;
  const double angle = std::max(0.0, in_side_m - straight_m) / kCornerRadius_m;
  const Pose2 start =
      straight(side, kCornerRadius_m + std::min(in_side_m, straight_m), settings_.side_m);
  return compose(
      start, {kCornerRadius_m * std::sin(angle), kCornerRadius_m * (1.0 - std::cos(angle)), angle});
}

void CorridorWorld::start_anywhere() {
  along_m_ = lap_m() * uniform_(engine_);
  truth_ = course(along_m_);
}

MotionIncrement CorridorWorld::drive() {
  along_m_ = std::fmod(along_m_ + settings_.step_m, lap_m());
  const Pose2 wanted = course(along_m_);
  MotionStep step = chord_step(compose(inverse(truth_), wanted), Eigen::Matrix3d::Zero());
  truth_ = wanted;
  step.covariance.diagonal() << settings_.turn_sigma_rad * settings_.turn_sigma_rad,
      settings_.distance_sigma_m * settings_.distance_sigma_m, 1e-10;
  step.twist(0) += settings_.turn_sigma_rad * normal_(engine_);
  step.twist(1) += settings_.distance_sigma_m * normal_(engine_);
  MotionIncrement reported;
  reported.append(step);
  return reported;
}

std::vector<CorridorWorld::Seen> CorridorWorld::look() {
  std::vector<Seen> seen;
  const Pose2 T_robot_map = inverse(truth_);
  for (std::size_t i = 0; i < landmarks_.size(); ++i) {
    const Eigen::Vector2d p = transform(T_robot_map, landmarks_[i]);
    if (p.norm() > settings_.range_max_m || p.norm() < 0.4) continue;
    if (std::abs(std::atan2(p.y(), p.x())) > settings_.half_view_rad) continue;
    if (uniform_(engine_) < settings_.missed_ratio) continue;
    seen.push_back({static_cast<int>(i), sighting_at(p, kinds_[i])});
  }
  if (uniform_(engine_) < settings_.clutter_per_frame) {
    const double range_m = 0.5 + (settings_.range_max_m - 0.5) * uniform_(engine_);
    const double bearing = settings_.half_view_rad * (2.0 * uniform_(engine_) - 1.0);
    const auto kind = static_cast<std::int8_t>(uniform_(engine_) * settings_.classes);
    seen.push_back(
        {-1, sighting_at({range_m * std::cos(bearing), range_m * std::sin(bearing)}, kind)});
  }
  return seen;
}

Sighting CorridorWorld::sighting_at(const Eigen::Vector2d& p_robot_m, std::int8_t kind) {
  Sighting sighting;
  sighting.polar.range_m = p_robot_m.norm() + settings_.range_sigma_m * normal_(engine_);
  sighting.polar.bearing_rad =
      std::atan2(p_robot_m.y(), p_robot_m.x()) + settings_.bearing_sigma_rad * normal_(engine_);
  sighting.polar.covariance(0, 0) = settings_.range_sigma_m * settings_.range_sigma_m;
  sighting.polar.covariance(1, 1) = settings_.bearing_sigma_rad * settings_.bearing_sigma_rad;
  sighting.kind = kind;
  return sighting;
}

}  // namespace roomwise::ekf
