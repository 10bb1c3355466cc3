#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <numbers>

#include "services/simulator/scenario/scenario.h"
#include "tests/pilot_svc/support/pilot_drive.h"

namespace roomwise::pilot {
namespace {

/// The living room's sofa, moved to where there is room all round it.
constexpr const char* kSofaInTheMiddle = R"(
[robot]
at_m = [1.0, 3.0]

[camera]
z_m = 0.4
pitch_down_rad = 0.1

[[material]]
name = "plain"
color = [0.5, 0.5, 0.5]

[[floor]]
least_m = [0.0, 0.0]
largest_m = [7.0, 6.0]
material = "plain"

[[wall]]
points_m = [[0.0, 0.0], [7.0, 0.0], [7.0, 6.0], [0.0, 6.0]]
closed = true
material = "plain"

[[sofa]]
at_m = [3.5, 3.0]
size_m = [0.9, 1.9, 0.8]
material = "plain"
)";

struct CircleCase {
  int sense;
  ViewNoise noise;
};

void PrintTo(const CircleCase& c, std::ostream* out) {
  *out << (c.sense > 0 ? "counter-clockwise" : "clockwise");
}

class CircleDrive : public testing::TestWithParam<CircleCase> {};

TEST_P(CircleDrive, KeepsHalfAMetreRoundASofa) {
  const auto scene = simulator::read_scenario(kSofaInTheMiddle, "sofa").scene;
  KinematicWorld world(scene, GetParam().noise, 1);
  PilotDrive drive(world, {.behaviour = Behaviour::kCircle,
                           .circle_distance_m = 0.5,
                           .circle_sense = GetParam().sense});
  double nearest_m = 10.0;
  double farthest_m = 0.0;
  double turned_rad = 0.0;
  drive.run(400.0, [&] {
    turned_rad = GetParam().sense * drive.report().progress.turned_about_object_rad;
    if (turned_rad <= 0.0) return;
    nearest_m = std::min(nearest_m, world.clearance_m());
    farthest_m = std::max(farthest_m, world.clearance_m());
  });
  std::cout << nearest_m << " to " << farthest_m << " m, " << world.time_s() << " s, "
            << drive.report().recoveries << " recoveries, failure "
            << static_cast<int>(drive.report().failure) << ", turned " << turned_rad << "\n";
  EXPECT_EQ(drive.report().state, State::kDone);
  EXPECT_GE(turned_rad, 2.0 * std::numbers::pi);
  EXPECT_GE(nearest_m, 0.4);
  EXPECT_LE(farthest_m, 0.6);
  EXPECT_EQ(world.contacts(), 0);
}

constexpr ViewNoise kNoisyView{.range_sigma_ratio = 0.01, .dropout_probability = 0.005};

INSTANTIATE_TEST_SUITE_P(BothSenses, CircleDrive,
                         testing::Values(CircleCase{1, {}}, CircleCase{-1, {}},
                                         CircleCase{1, kNoisyView}, CircleCase{-1, kNoisyView}));

}  // namespace
}  // namespace roomwise::pilot
