#include <gtest/gtest.h>

#include <iostream>

#include "tests/pilot_svc/support/pilot_drive.h"

namespace roomwise::pilot {
namespace {

struct GoToCase {
  double x_m;  ///< world
  double y_m;
  State end;
};

void PrintTo(const GoToCase& c, std::ostream* out) { *out << "to " << c.x_m << ", " << c.y_m; }

class GoToDrive : public testing::TestWithParam<GoToCase> {};

TEST_P(GoToDrive, ReachesThePointOrSaysThatThereIsNoWay) {
  KinematicWorld world(scenario_scene("living_room"), {}, 1);
  const Eigen::Vector2d goal_world_m(GetParam().x_m, GetParam().y_m);
  const Eigen::Vector2d goal_map_m = transform(inverse(world.T_world_robot()), goal_world_m);
  PilotDrive drive(world,
                   {.behaviour = Behaviour::kGoTo, .x_m = goal_map_m.x(), .y_m = goal_map_m.y()});
  drive.run(240.0);
  const double off_m = (world.T_world_robot().position_m() - goal_world_m).norm();
  std::cout << "off " << off_m << " m after " << world.time_s() << " s, driven "
            << drive.report().driven_m << " m, recoveries " << drive.report().recoveries << "\n";
  EXPECT_EQ(drive.report().state, GetParam().end);
  if (GetParam().end == State::kDone) {
    EXPECT_LE(off_m, 0.15);
  }
  if (GetParam().end == State::kFailed) {
    EXPECT_EQ(drive.report().failure, Failure::kNoWay);
  }
  EXPECT_EQ(world.contacts(), 0);
}

INSTANTIATE_TEST_SUITE_P(LivingRoom, GoToDrive,
                         testing::Values(GoToCase{4.2, 1.15, State::kDone},
                                         GoToCase{4.2, 3.6, State::kDone},
                                         GoToCase{1.6, 3.6, State::kDone},
                                         GoToCase{2.75, 3.55, State::kDone},
                                         GoToCase{8.0, 2.4, State::kFailed}));

}  // namespace
}  // namespace roomwise::pilot
