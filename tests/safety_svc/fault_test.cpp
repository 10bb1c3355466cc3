// What goes wrong while the robot drives at 0.3 m/s: the real services stop it, and say why. Every
// drive has a bus of its own; some go on side by side.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <future>
#include <map>
#include <optional>
#include <semaphore>
#include <thread>

#include "common/auth/command_signature.h"
#include "tests/safety_svc/support/safety_chain.h"
#include "tests/support/private_network.h"

namespace roomwise {
namespace {

using Part = SafetyChain::Part;
using Command = velocity_command_t;

constexpr std::int64_t kSettled_us = 150'000;  // TRUTH says the same for so long: it stands

// A machine that gives the listener nothing for so long gives the services nothing either, while
// the simulated robot drives on by the clock: such a drive tells nothing and is driven again.
constexpr double kStall_s = 0.06;
constexpr int kAttempts = 4;
constexpr double kSimulatedFaultAt_s = 9.0;
constexpr double kRecovery_s = 15.0;

/// What a fault did: from the instant of the fault on.
struct Outcome {
  bool has_driven = false;
  bool drives_again = false;     ///< where the fault is over by itself
  std::optional<double> stop_s;  ///< the wheels stood after this long; nothing: they went on
  double way_m = 0.0;
  double fastest_mps = 0.0;  ///< after the fault
  std::string reasons;       ///< all on SAFETY_STATE; what create_driver says if there is none
  create_state_t last_state{};
  std::string output;
  bool is_disturbed = false;  ///< by the machine: it tells nothing
};

struct Fault {
  std::string name;
  std::function<void(SafetyChain&)> strike;
  std::string reason;          ///< a part of it
  bool goes_on = false;        ///< the robot is to drive on undisturbed
  std::string simulated = {};  ///< or a fault of the simulated robot, 9 s after its start
  std::function<void(SafetyChain&)> before = {};  ///< it drives
  bool is_over = false;                           ///< by itself: the robot drives again
};

std::function<void(SafetyChain&)> signal_to(Part part, int signal) {
  return [part, signal](SafetyChain& chain) { chain.send_signal(part, signal); };
}

/// Publishes commands of its own at 100 Hz, as `change` makes them of the newest genuine one.
std::function<void(SafetyChain&)> publisher(std::function<void(Command&)> change) {
  return [change](SafetyChain& chain) {
    chain.also = [&chain, change](LcmBus& bus) {
      if (chain.commands.empty()) return;
      Command command = chain.commands.back();
      change(command);
      command.signature_size = static_cast<std::int32_t>(command.signature.size());
      bus.publish(channels::kVelCmd, command);
    };
  };
}

void turn_hard(Command& command) {
  command.allowed_speed_mps = 0.5;
  command.allowed_turn_rate_radps = 2.0;
  command.sequence += 1'000'000;
}

const std::vector<Fault>& faults() {
  static const std::vector<Fault> all = {
      {"NobodyAsksAnyMore", [](SafetyChain& chain) { chain.asks = false; }, "nobody asks"},
      {"SafetySvcKilled", signal_to(Part::kSafetySvc, SIGKILL), "commands silent"},
      {"SafetySvcFrozen", signal_to(Part::kSafetySvc, SIGSTOP), "commands silent"},
      {"SegmentSvcKilled", signal_to(Part::kSegmentSvc, SIGKILL), "no camera"},
      {"SegmentSvcFrozen", signal_to(Part::kSegmentSvc, SIGSTOP), "no camera"},
      {"KinectPubKilled", signal_to(Part::kKinectPub, SIGKILL), "no camera"},
      {"KinectPubFrozen", signal_to(Part::kKinectPub, SIGSTOP), "no camera"},
      {"CreateDriverKilled", signal_to(Part::kCreateDriver, SIGKILL), "nothing heard"},
      {"CreateDriverFrozen", signal_to(Part::kCreateDriver, SIGSTOP), "nothing heard"},
      {"EmergencyStop",
       [](SafetyChain& chain) {
         chain.also = [](LcmBus& bus) {
           estop_t press{};
           press.utime = utime_of(bus.now());
           press.source = "test";
           bus.publish(channels::kEstop, press);
         };
       },
       "emergency stop"},
      {"SecondPublisherUnsigned", publisher([](Command& command) {
         turn_hard(command);
         command.signature.clear();
       }),
       "", true},
      {"SecondPublisherForged", publisher(turn_hard), "", true},
      {"SecondPublisherRepeats", publisher([](Command&) {}), "", true},
      {.name = "LogOfTheDriveReplayed",
       .strike = [](SafetyChain& chain) { chain.play(chain.end_log()); },
       .reason = "",
       .goes_on = true,
       .before = [](SafetyChain& chain) { chain.start_log(); }},
      {"ClockSetForward",
       [](SafetyChain& chain) { chain.step_clock(std::chrono::seconds(20)); },
       "a clock jumped",
       false,
       "",
       {},
       true},
      {"ClockSetBack",
       [](SafetyChain& chain) { chain.step_clock(std::chrono::seconds(-20)); },
       "a clock jumped",
       false,
       "",
       {},
       true},
      {"CameraUnplugged", {}, "no camera", false, "camera_unplug,for_s=3", {}, true},
      {"SerialSilence", {}, "nothing heard", false, "silence,for_s=3"},
      {"SerialGarbage", {}, "nothing heard", false, "byte_flip,count=200"},
      {"Bump", {}, "bumper", false, "bump,side=left,for_s=3"},
      {"WheelDrop", {}, "wheel hangs", false, "wheel_drop,side=left,for_s=3"},
      {"Cliff", {}, "cliff", false, "cliff,for_s=3"},
  };
  return all;
}

/// When the simulated fault began to show: the last moment the robot's stream was as before. Where
/// the robot feels nothing, when it was to begin.
std::int64_t simulated_strike(const SafetyChain& chain, std::size_t from) {
  const auto shows = [](const create_state_t& s) {
    return s.bump_left != 0 || s.drop_left != 0 || s.cliff_left != 0 || s.cliff_front_left != 0 ||
           s.cliff_front_right != 0 || s.cliff_right != 0;
  };
  for (std::size_t i = from + 1; i < chain.states.size(); ++i) {
    const bool is_gap = chain.states[i].utime - chain.states[i - 1].utime > 100'000;
    if (is_gap || shows(chain.states[i])) return chain.states[i - 1].utime;
  }
  constexpr double kTruthPeriod_us = 1e6 / 60.0;
  const truth_t& first = chain.truth.front();
  const double since_start_us = kTruthPeriod_us * static_cast<double>(first.seq);
  return first.utime + std::llround(1e6 * kSimulatedFaultAt_s - since_start_us);
}

double way_between_m(const truth_t& a, const truth_t& b) {
  return std::hypot(b.true_x_m - a.true_x_m, b.true_y_m - a.true_y_m);
}

/// `is_over`: the robot may drive again after it stood once.
Outcome judge(const SafetyChain& chain, std::int64_t strike_utime, bool is_over) {
  Outcome outcome;
  const truth_t* before = nullptr;
  const truth_t* moved = nullptr;
  bool has_stood = false;
  for (std::size_t i = 1; i < chain.truth.size(); ++i) {
    const truth_t& a = chain.truth[i - 1];
    const truth_t& b = chain.truth[i];
    if (b.utime < strike_utime) continue;
    if (before == nullptr) before = &a;
    const double dt_s = 1e-6 * static_cast<double>(std::max<std::int64_t>(b.utime - a.utime, 1000));
    const double speed_mps = way_between_m(a, b) / dt_s;
    outcome.fastest_mps = std::max(outcome.fastest_mps, speed_mps);
    has_stood = is_over && (has_stood || speed_mps < 0.01);
    if (speed_mps > 0.01 && !has_stood) moved = &b;
  }
  if (before == nullptr) return outcome;
  if (moved == nullptr) moved = before;
  outcome.way_m = way_between_m(*before, *moved);
  if (chain.truth.back().utime - moved->utime > kSettled_us) {
    outcome.stop_s = 1e-6 * static_cast<double>(moved->utime - strike_utime);
  }
  return outcome;
}

std::string reasons_after(const SafetyChain& chain, std::int64_t strike_utime) {
  std::vector<std::string> reasons;
  for (const safety_state_t& state : chain.safety_states) {
    if (state.utime <= strike_utime || state.state < safety_state_t::STATE_STOP) continue;
    if (reasons.empty() || reasons.back() != state.reason_text) {
      reasons.push_back(state.reason_text);
    }
  }
  const auto is_silent = [strike_utime](const create_state_t& state) {
    return state.utime > strike_utime && state.driver_state == create_state_t::DRIVER_SILENT;
  };
  if (std::ranges::any_of(chain.states, is_silent)) {
    reasons.push_back("create_driver: commands silent");
  }
  std::string all;
  for (const std::string& reason : reasons) all += (all.empty() ? "" : "; then ") + reason;
  return all;
}

/// How many drives go on at once: more, and two cores do not give each its time.
std::counting_semaphore<>& free_places() {
  static std::counting_semaphore<> places(2);
  return places;
}

ChainSetup setup_of(const Fault& fault, int port) {
  ChainSetup setup;
  setup.url = "udpm://239.255.76.67:" + std::to_string(port) + "?ttl=0";
  // The faults are the matter here, not the blind zone: the floor counts as seen from near by.
  setup.safety = {"--floor_seen_from_m", "0.2"};
  if (!fault.simulated.empty()) {
    setup.simulator = {"--fault",
                       "at_s=" + std::to_string(kSimulatedFaultAt_s) + ",kind=" + fault.simulated};
  }
  return setup;
}

/// Drives until the robot is at its speed and, with a simulated fault, until just before it.
/// Whether it drives then.
bool get_going(SafetyChain& chain, const Fault& fault) {
  if (fault.before) fault.before(chain);
  if (!chain.listen_until([&] { return chain.true_speed_mps() > 0.29; }, 20.0)) return false;
  const auto simulated_s = [&] {
    return 1e-6 * static_cast<double>(chain.truth.back().utime - chain.truth.front().utime);
  };
  chain.forget_stalls();
  if (fault.simulated.empty()) {
    chain.listen_for(0.3);
  } else {
    chain.listen_until([&] { return simulated_s() > kSimulatedFaultAt_s - 0.3; }, 10.0);
  }
  return chain.true_speed_mps() > 0.28;
}

Outcome drive_into(const Fault& fault, int port) {
  SafetyChain chain(setup_of(fault, port));
  const bool has_driven = get_going(chain, fault);
  const std::size_t from = chain.states.empty() ? 0 : chain.states.size() - 1;
  std::int64_t strike_utime = chain.truth.empty() ? 0 : chain.truth.back().utime;
  if (fault.simulated.empty()) {
    fault.strike(chain);
    chain.listen_for(1.2);
  } else {
    chain.listen_for(1.6);
    strike_utime = simulated_strike(chain, from);
  }
  Outcome outcome = judge(chain, strike_utime, fault.is_over);
  if (fault.is_over) {
    outcome.drives_again =
        chain.listen_until([&] { return chain.true_speed_mps() > 0.29; }, kRecovery_s);
  }
  outcome.has_driven = has_driven;
  outcome.reasons = reasons_after(chain, strike_utime);
  if (!chain.states.empty()) {  // by stamp: a log that is played has old ones
    outcome.last_state = *std::ranges::max_element(chain.states, {}, &create_state_t::utime);
  }
  outcome.output = chain.output();
  outcome.is_disturbed = !has_driven || chain.longest_stall_s() > kStall_s;
  return outcome;
}

/// The first drive the machine let go on in peace; the last one if it never did.
Outcome undisturbed_drive_into(const Fault& fault, int port) {
  free_places().acquire();
  Outcome outcome = drive_into(fault, port);
  for (int i = 1; i < kAttempts && outcome.is_disturbed; ++i) outcome = drive_into(fault, port);
  free_places().release();
  return outcome;
}

class SafetyFault : public ::testing::TestWithParam<Fault> {
 protected:
  static void SetUpTestSuite() {
    enter_private_network();
    int port = 27800;
    for (const Fault& fault : faults()) {
      drives()[fault.name] =
          std::async(std::launch::async, undisturbed_drive_into, fault, ++port).share();
    }
  }
  static std::map<std::string, std::shared_future<Outcome>>& drives() {
    static std::map<std::string, std::shared_future<Outcome>> running;
    return running;
  }
};

TEST_P(SafetyFault, StopsTheWheelsOrChangesNothing) {
  const Fault& fault = GetParam();
  const Outcome outcome = drives().at(fault.name).get();
  std::printf("%-24s %5.0f ms %6.3f m  %s%s\n", fault.name.c_str(),
              outcome.stop_s ? 1e3 * *outcome.stop_s : -1.0, outcome.way_m, outcome.reasons.c_str(),
              outcome.is_disturbed ? "  (machine stalled)" : "");
  ASSERT_TRUE(outcome.has_driven) << outcome.output;
  EXPECT_LT(outcome.fastest_mps, 0.36);
  if (fault.goes_on) {
    EXPECT_FALSE(outcome.stop_s.has_value()) << outcome.reasons;
    const create_state_t& state = outcome.last_state;
    EXPECT_GT(state.refused_unsigned + state.refused_forged + state.refused_expired +
                  state.refused_out_of_order,
              30)
        << outcome.output;
    return;
  }
  ASSERT_TRUE(outcome.stop_s.has_value()) << outcome.output;
  // 0.3 m/s for 300 ms, and as much again for a machine that has other things to do.
  EXPECT_LT(outcome.way_m, 0.18);
  EXPECT_EQ(outcome.drives_again, fault.is_over) << outcome.output;
  EXPECT_NE(outcome.reasons.find(fault.reason), std::string::npos) << outcome.reasons;
}

INSTANTIATE_TEST_SUITE_P(All, SafetyFault, ::testing::ValuesIn(faults()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace roomwise
