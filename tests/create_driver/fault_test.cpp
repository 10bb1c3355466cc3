// The real create_driver against the simulated robot's quirks and faults, on its pseudo-terminal.
// Faults come after 3 s of a run of 7; at its end the robot drives again. A run is nearly all
// waiting, so every run of this file goes on at once, each on a bus of its own.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <future>
#include <map>
#include <thread>

#include "tests/create_driver/support/simulated_drive.h"
#include "tests/support/private_network.h"

namespace roomwise {
namespace {

/// The drive went on to its end, whatever happened on the way.
void expect_driving_at_the_end(const SimulatedDrive& drive) {
  EXPECT_TRUE(drive.ends_driving()) << drive.output;
  EXPECT_GT(drive.ends_moving_m(), 0.03);
}

std::int32_t resets(const SimulatedDrive& drive) {
  return drive.odometry.empty() ? -1 : drive.odometry.back().reset_counter;
}

/// How far odometry's travel is from the true one, both added up along the way.
double travel_error_m(const SimulatedDrive& drive) {
  double travel_m = 0.0;
  for (const odometry_t& step : drive.odometry) travel_m += step.distance_increment_m;
  double true_m = 0.0;
  for (std::size_t i = 1; i < drive.truth.size(); ++i) {
    true_m += std::hypot(drive.truth[i].true_x_m - drive.truth[i - 1].true_x_m,
                         drive.truth[i].true_y_m - drive.truth[i - 1].true_y_m);
  }
  return std::abs(travel_m - true_m);
}

/// Nothing was lost and no pose begun anew. (Where this machine left the driver without time, its
/// guardian stopped the robot, as it must: the driver says so and enters the mode again.)
void expect_undisturbed(const SimulatedDrive& drive) {
  expect_driving_at_the_end(drive);
  EXPECT_EQ(resets(drive), 0);
  EXPECT_LE(drive.count("mode_dropped"), drive.count("host_stalled")) << drive.output;
  EXPECT_LT(travel_error_m(drive), 0.03);
}

struct FaultCase {
  std::string name;
  DriveSetup setup;
  std::function<void(const SimulatedDrive&)> judge;
};

DriveSetup with_fault(const std::string& fault, double time_s = 7.0) {
  DriveSetup setup;
  setup.simulator_arguments = {"--fault", "at_s=3,kind=" + fault};
  setup.time_s = time_s;
  return setup;
}

DriveSetup with_simulator(std::vector<std::string> arguments) {
  DriveSetup setup;
  setup.simulator_arguments = std::move(arguments);
  return setup;
}

/// Bytes that are lost, wrong or late.
std::vector<FaultCase> faults_of_the_line() {
  return {
      {"NoneAtAll",
       {},
       [](const SimulatedDrive& drive) {
         expect_undisturbed(drive);
         EXPECT_EQ(drive.count("frames_damaged"), 0);
       }},
      {"LostBytesCostTheirFramesOnly", with_fault("byte_loss,count=5"), expect_undisturbed},
      {"FlippedBytesCostTheirFramesOnly", with_fault("byte_flip,count=5"),
       [](const SimulatedDrive& drive) {
         expect_undisturbed(drive);
         EXPECT_EQ(drive.count("frames_damaged"), 5);
       }},
      {"WrongLengthsCostTheirFramesOnly", with_fault("wrong_length,count=5"), expect_undisturbed},
      {"DuplicatedFramesAddNoMotion", with_fault("duplicate_frame,count=20"), expect_undisturbed},
      {"HeadersInTheDataMisleadNobody", with_fault("nineteen_in_data,for_s=1"),
       [](const SimulatedDrive& drive) {
         expect_driving_at_the_end(drive);
         EXPECT_EQ(drive.count("frames_damaged"), 0);
       }},
      {"SilenceOfThreeTenthsLosesNoMotion", with_fault("silence,for_s=0.3"),
       [](const SimulatedDrive& drive) {
         expect_driving_at_the_end(drive);
         EXPECT_EQ(resets(drive), 0);
         EXPECT_LT(travel_error_m(drive), 0.03);
       }},
      {"AHungUpPortIsTakenUpAgain", with_fault("hang_up,for_s=1"),
       [](const SimulatedDrive& drive) {
         expect_driving_at_the_end(drive);
         EXPECT_GE(resets(drive), 1);
       }},
      {"TheOtherReadingOfTheChecksumIsTakenUp",
       with_simulator({"--stream_checksum", "without_header"}),
       [](const SimulatedDrive& drive) {
         expect_driving_at_the_end(drive);
         EXPECT_EQ(drive.count("checksum_switched"), 1);
       }},
  };
}

/// A robot that restarts, leaves its mode or names it in its own way.
std::vector<FaultCase> faults_of_the_mode() {
  return {
      {"ARebootIsSeenAndTheRobotStartedAgain", with_fault("reboot", 12.0),
       [](const SimulatedDrive& drive) {
         expect_driving_at_the_end(drive);
         EXPECT_EQ(drive.last_state().robot_restarts, 1);
         EXPECT_EQ(resets(drive), 1);
       }},
      {"ADroppedModeIsEnteredAgain", with_fault("mode_drop"),
       [](const SimulatedDrive& drive) {
         expect_driving_at_the_end(drive);
         EXPECT_EQ(drive.last_state().mode_drops, 1);
       }},
      {"ModeThirtyTwoIsResetAway", with_fault("mode_32", 14.0),
       [](const SimulatedDrive& drive) {
         expect_driving_at_the_end(drive);
         EXPECT_EQ(drive.count("robot_reset"), 1);
       }},
      {"ARobotThatReportsItsModePlusOneDrives", with_simulator({"--mode_byte", "plus_one"}),
       [](const SimulatedDrive& drive) {
         expect_driving_at_the_end(drive);
         EXPECT_EQ(drive.last_state().mode, create_state_t::MODE_SAFE);
         EXPECT_EQ(drive.last_state().mode_byte, 3);
       }},
  };
}

FaultCase wrapping_counters(const std::string& name, const std::string& kind, double speed_mps) {
  DriveSetup setup = with_simulator({"--fault", "at_s=0,kind=" + kind});
  setup.speed_mps = speed_mps;
  setup.turn_rate_radps = 0.0;
  return {name, setup, [](const SimulatedDrive& drive) {
            expect_driving_at_the_end(drive);
            EXPECT_EQ(resets(drive), 0);
            EXPECT_EQ(drive.count("odometry_jump"), 0);
            ASSERT_FALSE(drive.truth.empty());
            EXPECT_NEAR(std::abs(drive.odometry.back().x_m),
                        std::abs(drive.truth.back().true_x_m - drive.truth.front().true_x_m), 0.03);
            EXPECT_GT(std::abs(drive.odometry.back().x_m), 0.2) << "did not come round";
          }};
}

FaultCase create_one(const std::string& name, const std::string& rounding) {
  DriveSetup setup = with_simulator({"--create_model", "create1", "--odometry_rounding", rounding});
  setup.driver_params =
      "model = \"create1\"\nwheel_base_m = 0.258\nangle_rounding = \"" + rounding + "\"\n";
  return {name, setup, [](const SimulatedDrive& drive) {
            expect_driving_at_the_end(drive);
            ASSERT_FALSE(drive.odometry.empty());
            EXPECT_EQ(drive.odometry.back().source, odometry_t::SOURCE_BODY);
            EXPECT_LT(travel_error_m(drive), 0.05);
            EXPECT_EQ(resets(drive), 0);
          }};
}

/// Encoders that wrap, jump, stick or round.
std::vector<FaultCase> faults_of_odometry() {
  return {
      wrapping_counters("CountersThatWrapForwardAreExact", "rollover_forward", 0.1),
      wrapping_counters("CountersThatWrapBackwardAreExact", "rollover_backward", -0.1),
      {"CountersThatJumpStartThePoseAnew", with_fault("rollover_forward"),
       [](const SimulatedDrive& drive) {
         expect_driving_at_the_end(drive);
         EXPECT_EQ(resets(drive), 1);
       }},
      {"AStuckEncoderIsReportedAsItIs", with_fault("encoder_stuck,side=left,for_s=1"),
       expect_driving_at_the_end},
      create_one("ACreateOneThatTruncatesTellsItsMotion", "truncate"),
      create_one("ACreateOneThatCarriesTellsItsMotion", "carry"),
  };
}

/// What happens to the robot on the floor.
std::vector<FaultCase> faults_of_the_world() {
  FaultCase cliff{"ACliffAtFullSpeedTripsTheRobotOnce", with_fault("cliff,for_s=1.5"),
                  [](const SimulatedDrive& drive) {
                    expect_driving_at_the_end(drive);
                    EXPECT_EQ(drive.last_state().mode_drops, 1) << "crept forward at the edge";
                  }};
  cliff.setup.speed_mps = 0.5;
  cliff.setup.turn_rate_radps = 1.5;
  return {
      cliff,
      {"AnAlmostEmptyBatteryIsReported", with_fault("battery_low"),
       [](const SimulatedDrive& drive) {
         expect_driving_at_the_end(drive);
         const create_state_t& last = drive.last_state();
         EXPECT_NEAR(last.battery_charge_ah / last.battery_capacity_ah, 0.05, 0.01);
       }},
      {"WhileTheChargerIsPluggedInTheRobotIsLeftInPassive", with_fault("charger,for_s=1.5"),
       [](const SimulatedDrive& drive) {
         expect_driving_at_the_end(drive);
         EXPECT_TRUE(drive.ever([](const create_state_t& state) {
           return state.charger_plugged == 1 && state.driver_state == create_state_t::DRIVER_HELD;
         }));
       }},
      {"ABumpIsReportedAndDoesNotStopTheRobotByItself", with_fault("bump,side=left,for_s=1"),
       [](const SimulatedDrive& drive) {
         expect_undisturbed(drive);
         EXPECT_TRUE(drive.ever([](const create_state_t& state) {
           return state.bump_left == 1 && state.bump_right == 0;
         }));
       }},
      {"AHangingWheelHoldsTheRobotUntilItStands", with_fault("wheel_drop,side=right,for_s=1.5"),
       [](const SimulatedDrive& drive) {
         expect_driving_at_the_end(drive);
         EXPECT_EQ(drive.last_state().mode_drops, 1);
         EXPECT_TRUE(drive.ever([](const create_state_t& state) {
           return state.drop_right == 1 && state.driver_state == create_state_t::DRIVER_HELD;
         }));
       }},
  };
}

const std::vector<FaultCase>& cases() {
  static const std::vector<FaultCase> all = [] {
    std::vector<FaultCase> joined;
    for (auto group :
         {faults_of_the_line, faults_of_the_mode, faults_of_odometry, faults_of_the_world}) {
      for (FaultCase& fault : group()) joined.push_back(std::move(fault));
    }
    for (std::size_t i = 0; i < joined.size(); ++i) {
      joined[i].setup.url = "udpm://239.255.76.67:" + std::to_string(27700 + i) + "?ttl=0";
    }
    return joined;
  }();
  return all;
}

class CreateFault : public ::testing::TestWithParam<FaultCase> {
 protected:
  static void SetUpTestSuite() {
    enter_private_network();
    for (const FaultCase& fault : cases()) {
      if (!is_asked_for(fault.name)) continue;
      drives().emplace(fault.name, std::async(std::launch::async, drive_in_simulator, fault.setup));
      std::this_thread::sleep_for(std::chrono::milliseconds(50));  // three processes have begun
    }
  }

  /// Whether this run's filter lets the case of that name through.
  static bool is_asked_for(const std::string& name) {
    const ::testing::TestSuite& suite = *::testing::UnitTest::GetInstance()->current_test_suite();
    for (int i = 0; i < suite.total_test_count(); ++i) {
      const ::testing::TestInfo& test = *suite.GetTestInfo(i);
      if (test.name() == "Case/" + name) return test.should_run();
    }
    return false;
  }

  static std::map<std::string, std::shared_future<SimulatedDrive>>& drives() {
    static std::map<std::string, std::shared_future<SimulatedDrive>> running;
    return running;
  }
};

TEST_P(CreateFault, Case) { GetParam().judge(drives().at(GetParam().name).get()); }

INSTANTIATE_TEST_SUITE_P(All, CreateFault, ::testing::ValuesIn(cases()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace roomwise
