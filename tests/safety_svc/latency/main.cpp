// safety_latency: how long the running robot takes to act on what it sees and feels, with every
// service at work, in a network of its own. A person asks it to turn on the spot; it sees, and is
// bumped once a second. Two histograms:
//   exposure -> VEL_CMD   from the middle of a frame's exposure to the first command that
//   safety_svc
//                         decided after that frame's SEGMENTS was on the bus
//   bump -> zero          from the instant the bumper is pressed to the command that stops the
//                         wheels on the serial wire
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <mutex>
#include <optional>

#include "common/bus/lcm_bus.h"
#include "common/channels.h"
#include "tests/pilot_svc/trial/trial_chain.h"
#include "tests/safety_svc/latency/histogram.h"
#include "tests/safety_svc/latency/serial_tap.h"
#include "tests/support/private_network.h"

namespace roomwise {
namespace {

using std::chrono::milliseconds;

constexpr double kWarmUp_s = 15.0;
constexpr double kBumpEvery_s = 1.0137;
constexpr double kBump_s = 0.3;
constexpr double kTurnRate_radps = 0.8;

/// Seconds of simulated time at which the bumper is pressed: not in step with the stream of the
/// robot's sensors, which comes every 15 ms.
std::vector<double> bump_times_s(double end_s) {
  std::vector<double> times_s;
  for (double at_s = kWarmUp_s; at_s + kBumpEvery_s < end_s; at_s += kBumpEvery_s) {
    times_s.push_back(at_s);
  }
  return times_s;
}

std::vector<std::string> bumps(double end_s) {
  std::vector<std::string> options;
  for (const double at_s : bump_times_s(end_s)) {
    options.push_back("--fault");
    options.push_back(fmt::format("at_s={:.4f},kind=bump,for_s={}", at_s, kBump_s));
  }
  return options;
}

/// What went over the wire to the robot, and when.
class Wire {
 public:
  void add(Time when, std::span<const std::uint8_t> bytes) {
    const std::lock_guard lock(mutex_);
    for (const std::uint8_t byte : bytes) {
      last_ = {last_[1], last_[2], last_[3], last_[4], byte};
      constexpr std::uint8_t kDriveDirect = 145;
      if (last_[0] != kDriveDirect) continue;
      const bool is_zero =
          std::all_of(last_.begin() + 1, last_.end(), [](int b) { return b == 0; });
      drives_.push_back({when, is_zero});
    }
  }
  /// The first command to stop after `when`, if the wheels were to turn at `when`.
  std::optional<Time> stopped_after(Time when) const {
    const std::lock_guard lock(mutex_);
    bool turns = false;
    for (const Drive& drive : drives_) {
      if (drive.when >= when && drive.is_zero)
        return turns ? std::optional(drive.when) : std::nullopt;
      if (drive.when < when) turns = !drive.is_zero;
    }
    return std::nullopt;
  }

 private:
  struct Drive {
    Time when;
    bool is_zero;
  };
  mutable std::mutex mutex_;
  std::array<int, 5> last_{};
  std::vector<Drive> drives_;
};

/// Listens, and asks for a turn on the spot.
class Watch {
 public:
  Watch(const std::string& url, double end_s) : bus_(url), end_s_(end_s) {
    bus_.subscribe(channels::kTruth, [this](const truth_t& m) { on_truth(m); });
    bus_.subscribe(channels::kSegments, [this](const segmentation_t& m) {
      if (since_start_s(bus_.now()) > kWarmUp_s)
        waiting_.push_back({time_from_utime(m.utime), bus_.now()});
    });
    bus_.subscribe(channels::kVelCmd, [this](const velocity_command_t& m) { on_command(m); });
    bus_.every(milliseconds(50), [this](Time now) { ask(now); });
  }
  void run() { bus_.run(); }
  Time start() const { return start_; }
  Histogram seeing;

 private:
  struct Seen {
    Time exposed;
    Time told;
  };
  double since_start_s(Time now) const { return start_ == Time{} ? 0.0 : seconds(now - start_); }
  void on_truth(const truth_t& message) {
    if (start_ != Time{}) return;
    constexpr double kTruthPeriod_us = 1e6 / 60.0;
    start_ = time_from_utime(message.utime) -
             Duration(std::llround(kTruthPeriod_us * static_cast<double>(message.seq)));
  }
  void on_command(const velocity_command_t& message) {
    const Time decided = time_from_utime(message.utime);
    std::erase_if(waiting_, [&](const Seen& seen) {
      if (decided < seen.told) return false;
      seeing.add(seconds(bus_.now() - seen.exposed));
      return true;
    });
  }
  void ask(Time now) {
    if (since_start_s(now) > end_s_) return bus_.stop();
    velocity_request_t request{};
    request.utime = utime_of(now);
    request.source = "latency";
    request.priority = velocity_request_t::PRIORITY_PERSON;
    request.valid_for_us = 200'000;
    request.requested_turn_rate_radps = kTurnRate_radps;
    bus_.publish(channels::kVelRequest, request);
  }

  LcmBus bus_;
  double end_s_;
  Time start_{};
  std::vector<Seen> waiting_;
};

int measure(TrialSetup setup, double minutes) {
  const double end_s = kWarmUp_s + 60.0 * minutes;
  setup.simulator = bumps(end_s);
  Wire wire;
  std::unique_ptr<SerialTap> tap;
  setup.driver_port = [&](const std::string& robot) {
    const std::string driver = robot + "-tapped";
    tap = std::make_unique<SerialTap>(robot, driver,
                                      [&](Time when, auto bytes) { wire.add(when, bytes); });
    return driver;
  };
  TrialChain chain(setup);
  Watch watch(setup.url, end_s);
  watch.run();
  if (!chain.ended().empty()) throw std::runtime_error("ended:" + chain.ended() + chain.output());
  Histogram feeling;
  for (const double at_s : bump_times_s(end_s)) {
    const Time pressed = watch.start() + Duration(std::llround(1e6 * at_s));
    if (const auto stopped = wire.stopped_after(pressed)) feeling.add(seconds(*stopped - pressed));
  }
  std::cout << watch.seeing.text("exposure -> VEL_CMD", 0.002)
            << feeling.text("bump -> zero on the wire", 0.002);
  return watch.seeing.count() > 0 && feeling.count() > 0 ? 0 : 1;
}

}  // namespace
}  // namespace roomwise

int main(int argc, char** argv) {
  roomwise::TrialSetup setup;
  setup.url = "udpm://239.255.76.67:27668?ttl=0&recv_buf_size=2097152";
  double minutes = 1.0;
  CLI::App app("Measures how long the running robot takes to act on what it sees and feels.");
  app.add_option("--scenario", setup.scenario, "of the simulator");
  app.add_option("--minutes", minutes, "of measuring")->check(CLI::Range(0.1, 1.5));
  app.add_option("--resolution", setup.resolution, "of the camera");
  CLI11_PARSE(app, argc, argv);
  try {
    roomwise::enter_private_network();
    return roomwise::measure(setup, minutes);
  } catch (const std::exception& error) {
    std::cerr << "safety_latency: " << error.what() << "\n";
    return 1;
  }
}
