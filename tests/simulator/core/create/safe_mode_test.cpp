// What takes a Create out of Safe mode, and what does not.
#include <gtest/gtest.h>

#include "tests/simulator/core/create/oi_host.h"

namespace roomwise::simulator {
namespace {

using Wheels = LeftRight<double>;

struct Case {
  const char* name;
  void (*happen)(BodyReadings&);
  Bytes drive;
  bool trips;
  friend void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
};

const Bytes kAhead = {145, 0, 200, 0, 200};
const Bytes kBack = {145, 0xFF, 0x38, 0xFF, 0x38};
const Bytes kBackTight = {145, 0xFF, 0x38, 0x00, 0x32};  // right -200, left 50: radius 0.07 m
const Bytes kSpin = {137, 0, 100, 0, 1};
const Bytes kStand = {145, 0, 0, 0, 0};

void cliff(BodyReadings& r) { r.cliff[2] = true; }
void wheel(BodyReadings& r) { r.wheel_drop.right = true; }
void charger(BodyReadings& r) { r.internal_charger = true; }
void dock(BodyReadings& r) { r.home_base = true; }
void bump(BodyReadings& r) { r.bump = {true, true}; }
void stall(BodyReadings& r) { r.overcurrent = {true, true}; }

class SafeMode : public ::testing::TestWithParam<Case> {};

TEST_P(SafeMode, TripsOrNot) {
  OiHost host;
  host.send({128, 131});
  host.send(GetParam().drive);
  const Wheels asked = host.interface.wheel_command_mps();
  host.wait(1);
  ASSERT_EQ(host.interface.mode(), OiMode::kSafe);
  GetParam().happen(host.readings);
  host.wait(1);
  if (!GetParam().trips) {
    EXPECT_EQ(host.interface.mode(), OiMode::kSafe);
    EXPECT_EQ(host.interface.wheel_command_mps(), asked);
    return;
  }
  EXPECT_EQ(host.interface.mode(), OiMode::kPassive);
  EXPECT_EQ(host.interface.wheel_command_mps(), Wheels{});
  host.readings = {};
  host.wait(1);
  host.send(GetParam().drive);
  EXPECT_EQ(host.interface.wheel_command_mps(), Wheels{}) << "until it is made Safe again";
  host.send({131});
  host.send(kAhead);
  EXPECT_EQ(host.interface.wheel_command_mps(), (Wheels{0.2, 0.2}));
}

TEST_P(SafeMode, FullModeMindsNothing) {
  OiHost host;
  host.send({128, 132});
  host.send(GetParam().drive);
  const Wheels asked = host.interface.wheel_command_mps();
  GetParam().happen(host.readings);
  host.wait(10);
  EXPECT_EQ(host.interface.mode(), OiMode::kFull);
  EXPECT_EQ(host.interface.wheel_command_mps(), asked);
}

INSTANTIATE_TEST_SUITE_P(Causes, SafeMode,
                         ::testing::Values(Case{"cliff_ahead", cliff, kAhead, true},
                                           Case{"cliff_back", cliff, kBack, false},
                                           Case{"cliff_back_tight", cliff, kBackTight, true},
                                           Case{"cliff_spin", cliff, kSpin, false},
                                           Case{"cliff_stand", cliff, kStand, false},
                                           Case{"wheel_drop", wheel, kAhead, true},
                                           Case{"wheel_drop_stand", wheel, kStand, true},
                                           Case{"charger", charger, kBack, true},
                                           Case{"home_base", dock, kStand, true},
                                           Case{"bump", bump, kAhead, false},
                                           Case{"stall", stall, kAhead, false}),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(Trip, MayLockTheModeAt32UntilReset) {
  OpenInterfaceParams params;
  params.locks_after_trip = true;
  OiHost host(params);
  host.send({128, 131});
  host.readings.wheel_drop.left = true;
  host.wait(1);
  host.readings = {};
  EXPECT_EQ(host.mode_byte(), 32);
  host.send({128, 131, 132});
  host.send(kAhead);
  EXPECT_EQ(host.mode_byte(), 32);
  EXPECT_EQ(host.interface.wheel_command_mps(), Wheels{});
  host.send({7});
  host.wait(150);
  host.send({128, 131});
  EXPECT_EQ(host.mode_byte(), 2);
}

}  // namespace
}  // namespace roomwise::simulator
