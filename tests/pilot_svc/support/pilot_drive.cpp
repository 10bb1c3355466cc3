#include "tests/pilot_svc/support/pilot_drive.h"

#include <cmath>
#include <stdexcept>

namespace roomwise::pilot {
namespace {

constexpr double kTurnsHard_radps = 0.3;

bool is_over(State state) {
  return state == State::kDone || state == State::kFailed || state == State::kIdle;
}

}  // namespace

PilotDrive::PilotDrive(KinematicWorld& world, const Goal& goal, const PilotParams& params)
    : world_(world), T_world_map_(world.T_world_robot()), pilot_(params) {
  pilot_.set_goal(goal);
}

void PilotDrive::run(double seconds_max, const std::function<void()>& watch) {
  const double end_s = world_.time_s() + seconds_max;
  while (world_.time_s() < end_s && !is_over(report().state)) {
    step();
    watch();
  }
}

void PilotDrive::step() {
  const Time now = time_from_utime(1'000'000 + 50'000 * ++steps_);
  bool used = pilot_.add_odometry({now, world_.T_odom_robot(), 0}) == InputResult::kUsed;
  if (steps_ % 2 == 1) used &= pilot_.add_view(now, world_.view()) == InputResult::kUsed;
  const Pose2 T_map_robot = compose(inverse(T_world_map_), world_.T_world_robot());
  used &= pilot_.add_pose(now, T_map_robot, true) == InputResult::kUsed;
  if (!used) throw std::logic_error("the pilot refused a sound input");
  const Motion motion = pilot_.tick(now);
  watch_turns(motion);
  world_.step(motion);
}

void PilotDrive::watch_turns(const Motion& motion) {
  if (std::abs(motion.turn_rate_radps) < kTurnsHard_radps) return;
  const bool is_other_way = motion.turn_rate_radps * turned_radps_ < 0.0;
  if (is_other_way && world_.time_s() - turned_s_ < 1.0) ++dithers_;
  turned_s_ = world_.time_s();
  turned_radps_ = motion.turn_rate_radps;
}

}  // namespace roomwise::pilot
