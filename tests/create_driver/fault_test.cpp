// The real create_driver against the simulated robot's quirks and faults, on its pseudo-terminal.
// Every fault comes after 3 s of a run of 7; at its end the robot drives again.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/create_driver/support/simulated_drive.h"
#include "tests/support/private_network.h"

namespace roomwise {
namespace {

class CreateFault : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { enter_private_network(); }

  static SimulatedDrive with_fault(const std::string& fault, DriveSetup setup = {}) {
    setup.simulator_arguments = {"--fault", "at_s=3,kind=" + fault};
    setup.time_s = 7.0;
    return drive_in_simulator(setup);
  }

  /// The drive went on to its end, whatever happened on the way.
  static void expect_driving_at_the_end(const SimulatedDrive& drive) {
    EXPECT_TRUE(drive.ends_driving()) << drive.output;
    EXPECT_GT(drive.ends_moving_m(), 0.03);
  }
  static std::int32_t resets(const SimulatedDrive& drive) {
    return drive.odometry.empty() ? -1 : drive.odometry.back().reset_counter;
  }
  /// How far odometry's travel is from the true one, both added up along the way.
  static double travel_error_m(const SimulatedDrive& drive) {
    double travel_m = 0.0;
    for (const odometry_t& step : drive.odometry) travel_m += step.distance_increment_m;
    double true_m = 0.0;
    for (std::size_t i = 1; i < drive.truth.size(); ++i) {
      true_m += std::hypot(drive.truth[i].true_x_m - drive.truth[i - 1].true_x_m,
                           drive.truth[i].true_y_m - drive.truth[i - 1].true_y_m);
    }
    return std::abs(travel_m - true_m);
  }
  /// Nothing was lost and no pose begun anew.
  static void expect_undisturbed(const SimulatedDrive& drive) {
    expect_driving_at_the_end(drive);
    EXPECT_EQ(resets(drive), 0);
    EXPECT_EQ(drive.count("mode_dropped"), 0);
    EXPECT_LT(travel_error_m(drive), 0.03);
  }
};

TEST_F(CreateFault, NoneAtAll) {
  const SimulatedDrive drive = drive_in_simulator({});
  expect_undisturbed(drive);
  EXPECT_EQ(drive.count("frames_damaged"), 0);
  EXPECT_EQ(drive.count("host_stalled"), 0);
}

TEST_F(CreateFault, LostBytesCostTheirFramesOnly) {
  expect_undisturbed(with_fault("byte_loss,count=5"));
}

TEST_F(CreateFault, FlippedBytesCostTheirFramesOnly) {
  const SimulatedDrive drive = with_fault("byte_flip,count=5");
  expect_undisturbed(drive);
  EXPECT_EQ(drive.count("frames_damaged"), 5);
}

TEST_F(CreateFault, WrongLengthsCostTheirFramesOnly) {
  expect_undisturbed(with_fault("wrong_length,count=5"));
}

TEST_F(CreateFault, DuplicatedFramesAddNoMotion) {
  expect_undisturbed(with_fault("duplicate_frame,count=20"));
}

TEST_F(CreateFault, HeadersInTheDataMisleadNobody) {
  const SimulatedDrive drive = with_fault("nineteen_in_data,for_s=1");
  expect_driving_at_the_end(drive);
  EXPECT_EQ(drive.count("frames_damaged"), 0);
}

TEST_F(CreateFault, SilenceOfThreeTenthsLosesNoMotion) {
  const SimulatedDrive drive = with_fault("silence,for_s=0.3");
  expect_driving_at_the_end(drive);
  EXPECT_EQ(resets(drive), 0);
  EXPECT_LT(travel_error_m(drive), 0.03);
}

TEST_F(CreateFault, AHungUpPortIsTakenUpAgain) {
  const SimulatedDrive drive = with_fault("hang_up,for_s=1");
  expect_driving_at_the_end(drive);
  EXPECT_GE(resets(drive), 1);
}

TEST_F(CreateFault, ARebootIsSeenAndTheRobotStartedAgain) {
  DriveSetup setup;
  setup.time_s = 12.0;
  setup.simulator_arguments = {"--fault", "at_s=3,kind=reboot"};
  const SimulatedDrive drive = drive_in_simulator(setup);
  expect_driving_at_the_end(drive);
  EXPECT_EQ(drive.states.back().robot_restarts, 1);
  EXPECT_EQ(resets(drive), 1);
}

TEST_F(CreateFault, ADroppedModeIsEnteredAgain) {
  const SimulatedDrive drive = with_fault("mode_drop");
  expect_driving_at_the_end(drive);
  EXPECT_EQ(drive.states.back().mode_drops, 1);
}

TEST_F(CreateFault, ModeThirtyTwoIsResetAway) {
  DriveSetup setup;
  setup.time_s = 14.0;
  setup.simulator_arguments = {"--fault", "at_s=3,kind=mode_32"};
  const SimulatedDrive drive = drive_in_simulator(setup);
  expect_driving_at_the_end(drive);
  EXPECT_EQ(drive.count("robot_reset"), 1);
}

TEST_F(CreateFault, CountersThatWrapEitherWayAreExact) {
  for (const auto& [kind, speed_mps] :
       {std::pair("rollover_forward", 0.1), std::pair("rollover_backward", -0.1)}) {
    DriveSetup setup;
    setup.simulator_arguments = {"--fault", std::string("at_s=0,kind=") + kind};
    setup.speed_mps = speed_mps;
    setup.turn_rate_radps = 0.0;
    const SimulatedDrive drive = drive_in_simulator(setup);
    expect_driving_at_the_end(drive);
    EXPECT_EQ(resets(drive), 0) << kind;
    EXPECT_EQ(drive.count("odometry_jump"), 0) << kind;
    ASSERT_FALSE(drive.truth.empty());
    EXPECT_NEAR(std::abs(drive.odometry.back().x_m),
                std::abs(drive.truth.back().true_x_m - drive.truth.front().true_x_m), 0.03)
        << kind;
    EXPECT_GT(std::abs(drive.odometry.back().x_m), 0.2) << kind << " did not come round";
  }
}

TEST_F(CreateFault, CountersThatJumpStartThePoseAnew) {
  const SimulatedDrive drive = with_fault("rollover_forward");
  expect_driving_at_the_end(drive);
  EXPECT_EQ(resets(drive), 1);
}

TEST_F(CreateFault, AStuckEncoderIsReportedAsItIs) {
  expect_driving_at_the_end(with_fault("encoder_stuck,side=left,for_s=1"));
}

TEST_F(CreateFault, AnAlmostEmptyBatteryIsReported) {
  const SimulatedDrive drive = with_fault("battery_low");
  expect_driving_at_the_end(drive);
  const create_state_t& last = drive.states.back();
  EXPECT_NEAR(last.battery_charge_ah / last.battery_capacity_ah, 0.05, 0.01);
}

TEST_F(CreateFault, WhileTheChargerIsPluggedInTheRobotIsLeftInPassive) {
  const SimulatedDrive drive = with_fault("charger,for_s=1.5");
  expect_driving_at_the_end(drive);
  EXPECT_TRUE(drive.ever([](const create_state_t& state) {
    return state.charger_plugged == 1 && state.driver_state == create_state_t::DRIVER_HELD;
  }));
}

TEST_F(CreateFault, ABumpIsReportedAndDoesNotStopTheRobotByItself) {
  const SimulatedDrive drive = with_fault("bump,side=left,for_s=1");
  expect_undisturbed(drive);
  EXPECT_TRUE(drive.ever(
      [](const create_state_t& state) { return state.bump_left == 1 && state.bump_right == 0; }));
}

TEST_F(CreateFault, AHangingWheelHoldsTheRobotUntilItStands) {
  const SimulatedDrive drive = with_fault("wheel_drop,side=right,for_s=1.5");
  expect_driving_at_the_end(drive);
  EXPECT_EQ(drive.states.back().mode_drops, 1);
  EXPECT_TRUE(drive.ever([](const create_state_t& state) {
    return state.drop_right == 1 && state.driver_state == create_state_t::DRIVER_HELD;
  }));
}

TEST_F(CreateFault, ACliffAtFullSpeedTripsTheRobotOnce) {
  DriveSetup setup;
  setup.speed_mps = 0.5;
  setup.turn_rate_radps = 1.5;
  const SimulatedDrive drive = with_fault("cliff,for_s=1.5", setup);
  expect_driving_at_the_end(drive);
  EXPECT_EQ(drive.states.back().mode_drops, 1) << "crept forward at the edge";
}

TEST_F(CreateFault, ARobotThatReportsItsModePlusOneDrives) {
  DriveSetup setup;
  setup.simulator_arguments = {"--mode_byte", "plus_one"};
  const SimulatedDrive drive = drive_in_simulator(setup);
  expect_driving_at_the_end(drive);
  EXPECT_EQ(drive.states.back().mode, create_state_t::MODE_SAFE);
  EXPECT_EQ(drive.states.back().mode_byte, 3);
}

TEST_F(CreateFault, TheOtherReadingOfTheChecksumIsTakenUp) {
  DriveSetup setup;
  setup.simulator_arguments = {"--stream_checksum", "without_header"};
  const SimulatedDrive drive = drive_in_simulator(setup);
  expect_driving_at_the_end(drive);
  EXPECT_EQ(drive.count("checksum_switched"), 1);
}

TEST_F(CreateFault, ACreateOneDrivesAndTellsItsMotionWithEitherRounding) {
  for (const std::string rounding : {"truncate", "carry"}) {
    DriveSetup setup;
    setup.simulator_arguments = {"--create_model", "create1", "--odometry_rounding", rounding};
    setup.driver_params =
        "model = \"create1\"\nwheel_base_m = 0.258\nangle_rounding = \"" + rounding + "\"\n";
    const SimulatedDrive drive = drive_in_simulator(setup);
    expect_driving_at_the_end(drive);
    ASSERT_FALSE(drive.odometry.empty()) << rounding;
    EXPECT_EQ(drive.odometry.back().source, odometry_t::SOURCE_BODY);
    EXPECT_LT(travel_error_m(drive), 0.05) << rounding;
    EXPECT_EQ(resets(drive), 0) << rounding;
  }
}

}  // namespace
}  // namespace roomwise
