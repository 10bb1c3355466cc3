#include <gtest/gtest.h>

#include <iostream>
#include <string>

#include "tests/pilot_svc/support/coverage.h"
#include "tests/pilot_svc/support/pilot_drive.h"

namespace roomwise::pilot {
namespace {

struct WanderCase {
  std::string scenario;
  ViewNoise noise;
  double covered_least;  ///< of the floor it can get to, in 10 minutes
};

void PrintTo(const WanderCase& c, std::ostream* out) {
  *out << c.scenario << (c.noise.range_sigma_ratio > 0.0 ? ", noisy" : "");
}

class WanderDrive : public testing::TestWithParam<WanderCase> {};

TEST_P(WanderDrive, TenMinutesWithoutContactCoverTheFloor) {
  KinematicWorld world(scenario_scene(GetParam().scenario), GetParam().noise, 1);
  PilotDrive drive(world, {.behaviour = Behaviour::kWander});
  Coverage coverage(world.body_plan(), world.T_world_robot().position_m());
  drive.run(600.0, [&] { coverage.visit(world.T_world_robot().position_m()); });
  const Report& report = drive.report();
  std::cout << GetParam().scenario << ": " << 100.0 * coverage.ratio() << " % of "
            << coverage.floor_m2() << " m2, " << report.driven_m << " m driven, "
            << report.recoveries << " recoveries, " << drive.dithers() << " dithers\n";
  EXPECT_NE(report.state, State::kFailed);
  EXPECT_EQ(world.contacts(), 0);
  EXPECT_GE(coverage.ratio(), GetParam().covered_least);
  EXPECT_LE(drive.dithers(), 60);
}

constexpr ViewNoise kNoisy{.range_sigma_ratio = 0.02, .dropout_probability = 0.02};

INSTANTIATE_TEST_SUITE_P(
    Scenarios, WanderDrive,
    testing::Values(WanderCase{"living_room", {}, 0.4}, WanderCase{"living_room", kNoisy, 0.4},
                    WanderCase{"apartment", {}, 0.2}, WanderCase{"apartment", kNoisy, 0.2},
                    WanderCase{"crowd", {}, 0.15}, WanderCase{"crowd", kNoisy, 0.15}));

}  // namespace
}  // namespace roomwise::pilot
