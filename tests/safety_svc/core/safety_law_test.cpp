// What holds for every request, world and moment.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "services/safety_svc/core/arc.h"
#include "services/safety_svc/core/stopping.h"
#include "tests/safety_svc/support/driven_world.h"

namespace roomwise::safety {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// A real number in [low, high], with the ends and zero often.
double number(double low, double high) {
  const int n = *rc::gen::inRange(0, 1001);
  if (n < 20) return low;
  if (n > 980) return high;
  return n < 40 && low < 0.0 ? 0.0 : low + (high - low) * n / 1000.0;
}

/// Any double: huge, tiny, not a number.
double any_number() {
  const auto bits = *rc::gen::arbitrary<std::uint64_t>();
  const int kind = *rc::gen::inRange(0, 4);
  if (kind == 0) return std::bit_cast<double>(bits);
  if (kind == 1) return std::numeric_limits<double>::quiet_NaN();
  if (kind == 2) return std::numeric_limits<double>::infinity();
  return number(-3.0, 3.0);
}

void expect_no_more(const Request& granted, const Request& asked) {
  RC_ASSERT(std::isfinite(granted.speed_mps) && std::isfinite(granted.turn_rate_radps));
  RC_ASSERT(std::abs(granted.speed_mps) <= std::abs(asked.speed_mps));
  RC_ASSERT(std::abs(granted.turn_rate_radps) <= std::abs(asked.turn_rate_radps));
  RC_ASSERT(granted.speed_mps * asked.speed_mps >= 0.0);
  RC_ASSERT(granted.turn_rate_radps * asked.turn_rate_radps >= 0.0);
}

bool is_zero(const Request& motion) {
  return motion.speed_mps == 0.0 && motion.turn_rate_radps == 0.0;
}

RC_GTEST_PROP(StoppingLaw, TheSpeedForADistanceStopsWithinItAndNoSlowerThanNeedBe, ()) {
  const double distance_m = number(0.0, 10.0);
  const double speed_mps = stopping_speed_mps(distance_m);
  RC_ASSERT(std::abs(stopping_distance_m(speed_mps) - distance_m) < 1e-9);
  RC_ASSERT(stopping_speed_mps(distance_m + number(0.0, 1.0)) >= speed_mps);
  RC_ASSERT(stopping_speed_mps(-number(0.0, 1.0)) == 0.0);
}

RC_GTEST_PROP(SafetyLaw, NeverMoreThanAskedAndNeverTheOtherWay, ()) {
  DrivenWorld drive;
  const int posts = *rc::gen::inRange(0, 6);
  for (int i = 0; i < posts; ++i) drive.discs.push_back({{number(0.7, 3.0), number(-1, 1)}, 0.1});
  for (int leg = 0; leg < 6; ++leg) {
    drive.ask(number(-1.0, 1.0), number(-5.0, 5.0));
    drive.body.bump = *rc::gen::inRange(0, 8) == 0;
    drive.body.cliff = *rc::gen::inRange(0, 8) == 0;
    drive.body.near_wall = *rc::gen::inRange(0, 4) == 0;
    for (int i = 0; i < 25; ++i) expect_no_more(drive.step().granted, drive.request);
  }
}

/// From whatever the robot does now: on for the reaction time, then braking, it ends before
/// everything it knows of.
void expect_can_stop(const DrivenWorld& drive, const Request& motion) {
  if (motion.speed_mps <= 0.0) return;
  const double way_m = stopping_distance_m(motion.speed_mps);
  const double curvature = motion.turn_rate_radps / motion.speed_mps;
  const Pose2& here = drive.T_odom_robot;
  for (double s_m = 0.0; s_m <= way_m; s_m += 0.01) {
    const Eigen::Vector2d p_m = compose(here, along_arc(s_m, curvature)).position_m();
    for (double bearing_rad = 0.0; bearing_rad < 6.28; bearing_rad += 0.1) {
      const Eigen::Vector2d rim =
          p_m + drive.params.robot_radius_m *
                    Eigen::Vector2d(std::cos(bearing_rad), std::sin(bearing_rad));
      const bool was_there = (rim - here.position_m()).norm() <= drive.params.robot_radius_m + 0.05;
      if (was_there) continue;
      RC_ASSERT(drive.world.memory().at(drive.now(), rim).ground != Ground::kClosed);
    }
  }
}

RC_GTEST_PROP(SafetyLaw, AtAnyAllowedSpeedItStopsBeforeEverythingItKnowsOf, ()) {
  DrivenWorld drive;
  const int posts = *rc::gen::inRange(1, 12);
  for (int i = 0; i < posts; ++i) {
    const double bearing_rad = number(-3.0, 3.0);
    const double range_m = number(0.8, 3.0);
    drive.discs.push_back(
        {{range_m * std::cos(bearing_rad), range_m * std::sin(bearing_rad)}, number(0.03, 0.3)});
  }
  for (int leg = 0; leg < 8; ++leg) {
    drive.ask(number(-0.3, 0.5), number(-1.5, 1.5));
    for (int i = 0; i < 60; ++i) {
      expect_can_stop(drive, drive.step().granted);
      const bool has_met = drive.clearance_m() <= 0.0;
      RC_ASSERT(!has_met || std::abs(drive.granted.motion.speed_mps) <= kCreep_mps + 1e-9);
      if (has_met) return;
    }
  }
}

RC_GTEST_PROP(SafetyLaw, TheNearerTheWallTheSlower, ()) {
  const double way_m = number(0.3, 1.0);
  const double asked_mps = number(0.05, 0.5);
  const double turn_radps = number(-0.5, 0.5);
  const Instant now{seconds(10), time_from_utime(1'700'000'000'000'000)};
  double before_mps = 0.0;
  for (double wall_m = way_m; wall_m < way_m + 0.3; wall_m += 0.02) {
    ObstacleMemory memory;
    std::vector<double> free_m(91);
    for (std::size_t bin = 0; bin < free_m.size(); ++bin) {
      free_m[bin] = wall_m / std::cos((static_cast<double>(bin) - 45.0) * 0.0175);
    }
    const std::vector<double> unknown(91, 0.0);
    const FreeView view{.first_bearing_rad = -45 * 0.0175,
                        .bearing_step_rad = 0.0175,
                        .free_range_m = free_m,
                        .unknown_ratio = unknown,
                        .obstacle_range_m = free_m,
                        .floor_seen_from_m = 0.01};
    memory.overlook_round(now, {}, 0.45);
    const SafetyParams params;
    RC_ASSERT(memory.see(now, {}, view, params.robot_radius_m + params.margin_m));
    const CorridorView corridor =
        sweep(now, memory, {}, turn_radps / asked_mps, stopping_distance_m(asked_mps), params);
    const double allowed_mps = std::min(asked_mps, stopping_speed_mps(corridor.free_m));
    RC_ASSERT(allowed_mps >= before_mps);
    RC_ASSERT(corridor.free_m + params.robot_radius_m <= wall_m || corridor.free_m == 0.0);
    before_mps = allowed_mps;
  }
}

RC_GTEST_PROP(SafetyLaw, SilenceOfAnyInputEndsInZero, ()) {
  DrivenWorld drive;
  drive.ask(number(-0.5, 0.5), number(-1.0, 1.0));
  drive.run(seconds(2));
  const int silent = *rc::gen::inRange(0, 4);
  drive.has_camera = silent != 0;
  drive.has_odometry = silent != 1;
  drive.has_body = silent != 2;
  drive.asks = silent != 3;
  drive.run(milliseconds(400));
  RC_ASSERT(is_zero(drive.step().granted));
}

RC_GTEST_PROP(SafetyLaw, AStampFromTheFutureEndsInZeroAtOnce, ()) {
  DrivenWorld drive;
  drive.ask(0.3, 0.0);
  drive.run(seconds(2));
  drive.stamp_ahead = kFutureSlack + Duration(*rc::gen::inRange(1, 1'000'000'000));
  RC_ASSERT(is_zero(drive.step().granted));
  RC_ASSERT(is_zero(drive.step().granted));
}

RC_GTEST_PROP(SafetyLaw, AClockThatIsSetEndsInZero, ()) {
  DrivenWorld drive;
  drive.ask(0.3, 0.0);
  drive.run(seconds(2));
  const int sign = *rc::gen::element(-1, 1);
  Instant now = drive.now();
  now.steady += milliseconds(20);
  now.wall +=
      milliseconds(20) + sign * (kClockStep + Duration(*rc::gen::inRange(1, 1'000'000'000)));
  drive.world.tick(now);
  const Decision decision = decide(now, drive.world, drive.granted, drive.params);
  RC_ASSERT(is_zero(decision.granted));
  RC_ASSERT(decision.reasons.has(Reason::kClock));
}

RC_GTEST_PROP(SafetyLaw, NumbersThatAreNoneEndInZero, ()) {
  DrivenWorld drive;
  drive.ask(0.3, 0.0);
  drive.run(seconds(2));
  (*rc::gen::inRange(0, 2) == 0 ? drive.request.speed_mps : drive.request.turn_rate_radps) =
      *rc::gen::element(std::numeric_limits<double>::quiet_NaN(),
                        std::numeric_limits<double>::infinity(), 1e300, -1e300);
  const Decision decision = drive.step();
  RC_ASSERT(is_zero(decision.granted));
  RC_ASSERT(decision.first == Reason::kBadRequest);
}

RC_GTEST_PROP(SafetyLaw, NothingHostileCrashesOrMoves, ()) {
  DrivenWorld drive;
  drive.ask(0.3, 0.1);
  drive.run(seconds(1));
  for (int i = 0; i < 20; ++i) {
    OdometrySample sample = drive.odometry_sample();
    sample.distance_m = any_number();
    sample.turn_rad = any_number();
    sample.T_odom_robot = {any_number(), any_number(), any_number()};
    sample.interval = Duration(*rc::gen::arbitrary<std::int64_t>());
    (void)drive.world.hear_odometry(drive.now(), sample);
    CameraSetup camera = DrivenWorld::camera();
    camera.p_robot_camera_m = {any_number(), any_number(), any_number()};
    camera.quat_wxyz = {any_number(), any_number(), any_number(), any_number()};
    camera.fy_px = any_number();
    (void)drive.world.hear_frame(drive.now(), drive.now().wall, camera);
    FloorView view = drive.view();
    const std::vector<double> free_m = {any_number(), any_number(), any_number()};
    const std::vector<double> unknown = {any_number(), any_number(), any_number()};
    view.free.free_range_m = free_m;
    view.free.unknown_ratio = unknown;
    const std::vector<double> obstacle_m = {any_number(), any_number(), any_number()};
    view.free.obstacle_range_m = obstacle_m;
    view.free.first_bearing_rad = any_number();
    view.free.bearing_step_rad = any_number();
    view.floor_normal = {any_number(), any_number(), any_number()};
    view.floor_height_m = any_number();
    (void)drive.world.hear_view(drive.now(), view);
    (void)drive.world.requests.hear(drive.now(),
                                    {.request = {any_number(), any_number()},
                                     .source = "hostile",
                                     .priority = *rc::gen::arbitrary<int>(),
                                     .valid_for = Duration(*rc::gen::arbitrary<std::int64_t>()),
                                     .decided = drive.now().wall});
    const Decision decision = decide(drive.now(), drive.world, drive.granted, drive.params);
    const auto* const heard = drive.world.requests.winner(drive.now());
    expect_no_more(decision.granted, heard == nullptr ? Request{} : heard->request);
    RC_ASSERT(std::abs(decision.granted.speed_mps) <= drive.params.speed_max_mps);
  }
}

}  // namespace
}  // namespace roomwise::safety
