#include "services/simulator/core/create/simulated_create.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "services/simulator/core/create/body_sensors.h"
#include "tests/simulator/core/create/oi_host.h"

namespace roomwise::simulator {
namespace {

/// A Create and a host that streams the whole state.
class Session {
 public:
  explicit Session(const SimulatedCreate::Setup& setup = {}) : create(setup) {}

  void send(const Bytes& bytes) { create.receive(bytes); }
  void run(double duration_s) {
    const Duration end = create.now() + Duration(static_cast<std::int64_t>(duration_s * 1e6));
    while (create.now() < end) create.step(plan, received);
  }
  void stream_everything() {
    send({128, 131, 148, 1, 100});
    run(0.05);
  }

  GroundPlan plan;
  SimulatedCreate create;
  Bytes received;
};

SimulatedCreate::Setup exact() {
  SimulatedCreate::Setup setup;
  setup.robot.slip_ratio = 0.0;
  setup.robot.slip_m2_per_m = 0.0;
  setup.robot.left_wheel_ratio = 1.0;
  setup.robot.right_wheel_ratio = 1.0;
  setup.robot.wheel_base_ratio = 1.0;
  return setup;
}

TEST(SimulatedCreate, DrivesAsCommandedThroughTheLine) {
  Session session(exact());
  session.send({128, 131, 145, 0, 200, 0, 200});
  session.run(1.05);
  EXPECT_NEAR(session.create.motion().pose().x_m, 0.2, 0.01);
  session.send({145, 0, 0, 0, 0});
  session.run(0.2);
  const double x_m = session.create.motion().pose().x_m;
  session.run(1.0);
  EXPECT_EQ(session.create.motion().pose().x_m, x_m);
}

TEST(SimulatedCreate, ABumpInSafeDoesNotStopIt) {
  Session session;
  session.plan.walls = {{{0.4, -1.0}, {0.4, 1.0}}};
  session.send({128, 131, 145, 0, 200, 0, 200});
  session.run(3.0);
  EXPECT_EQ(session.create.interface().mode(), OiMode::kSafe);
  session.send({149, 4, 7, 14, 54, 41});
  session.run(0.05);
  ASSERT_EQ(session.received.size(), 6U);
  EXPECT_EQ(session.received[0], 3) << "both bumpers";
  EXPECT_EQ(session.received[1], 0b11000) << "stalled: both wheels over their current";
  EXPECT_GT(word_at(session.received, 2), 1000);
  EXPECT_EQ(word_at(session.received, 4), 200) << "the request stays";
}

TEST(SimulatedCreate, StopsBeforeACliffInSafeAtFullSpeed) {
  Session session;
  session.plan.holes = {{{{1.0, -1.0}, {2.0, -1.0}, {2.0, 1.0}, {1.0, 1.0}}}};
  session.send({128, 131, 145, 1, 244, 1, 244});
  session.run(5.0);
  EXPECT_EQ(session.create.interface().mode(), OiMode::kPassive);
  EXPECT_GT(session.create.motion().pose().x_m, 0.8);
  EXPECT_LT(session.create.motion().pose().x_m, 0.93);
  EXPECT_FALSE(session.create.motion().wheels().left.dropped);
}

TEST(SimulatedCreate, FallsInFull) {
  Session session;
  session.plan.holes = {{{{1.0, -1.0}, {2.0, -1.0}, {2.0, 1.0}, {1.0, 1.0}}}};
  session.send({128, 132, 145, 1, 244, 1, 244});
  session.run(5.0);
  session.received.clear();
  session.send({142, 7});
  session.run(0.05);
  EXPECT_NE(session.received.at(0) & 12, 0) << "a wheel hangs";
  EXPECT_EQ(session.create.interface().mode(), OiMode::kFull);
}

TEST(SimulatedCreate, BumpersKnowTheSide) {
  const auto bump_at = [](double bearing_rad) {
    Session session;
    session.plan.discs = {{{0.19 * std::cos(bearing_rad), 0.19 * std::sin(bearing_rad)}, 0.02}};
    session.run(0.02);
    session.send({128, 142, 7});
    session.run(0.05);
    return session.received.at(0);
  };
  EXPECT_EQ(bump_at(0.8), 2);
  EXPECT_EQ(bump_at(0.0), 3);
  EXPECT_EQ(bump_at(-0.8), 1);
  EXPECT_EQ(bump_at(2.5), 0) << "there is no bumper behind";
}

TEST(SimulatedCreate, LightBumpersSeeBeforeTheyTouch) {
  Session session;
  session.plan.walls = {{{-1.0, 0.22}, {1.0, 0.22}}};
  session.run(0.02);
  session.send({128, 149, 3, 45, 46, 51});
  session.run(0.05);
  EXPECT_EQ(session.received.at(0), 1) << "left";
  EXPECT_GT(word_at(session.received, 1), 500);
  EXPECT_EQ(word_at(session.received, 3), 0);
}

TEST(SimulatedCreate, WallSensorLooksToTheRight) {
  Session session;
  session.plan.walls = {{{-1.0, -0.2}, {1.0, -0.2}}};
  session.run(0.02);
  session.send({128, 142, 8});
  session.run(0.05);
  EXPECT_EQ(session.received, Bytes{1});
}

TEST(SimulatedCreate, ChargesInPassiveButNotInFull) {
  SimulatedCreate::Setup setup;
  setup.faults = {parse_fault("at_s=0,kind=charger,for_s=100")};
  const auto current_ma = [&](std::uint8_t mode) {
    Session session(setup);
    session.send({128, mode});
    session.run(0.1);
    session.send({149, 2, 23, 21});
    session.run(0.05);
    return std::pair{word_at(session.received, 0) > 0, session.received.at(2)};
  };
  EXPECT_EQ(current_ma(128), (std::pair{true, std::uint8_t{2}}));
  EXPECT_EQ(current_ma(131), (std::pair{true, std::uint8_t{2}})) << "the charger trips Safe";
  EXPECT_EQ(current_ma(132), (std::pair{false, std::uint8_t{0}}));
}

TEST(SimulatedCreate, DrivingDrainsTheBattery) {
  Session session;
  session.send({128, 132, 145, 1, 244, 1, 244});
  const auto charge_mah = [&] {
    session.received.clear();
    session.send({142, 25});
    session.run(0.05);
    return word_at(session.received, 0);
  };
  const int before = charge_mah();
  session.run(60.0);
  EXPECT_NEAR(before - charge_mah(), 10, 3) << "about 0.6 A for a minute";
}

TEST(SimulatedCreate, WrongBaudIsGarbageBothWays) {
  Session session;
  session.create.set_host_baud(57600);
  session.send({128, 131});
  session.run(0.1);
  EXPECT_EQ(session.create.interface().mode(), OiMode::kOff);
  session.create.set_host_baud(115200);
  session.send({128, 148, 1, 7});
  session.run(0.1);
  session.received.clear();
  session.create.set_host_baud(19200);
  session.run(1.0);
  EXPECT_FALSE(session.received.empty());
  const Bytes frame = {19, 2, 7, 0, 228};
  EXPECT_EQ(
      std::search(session.received.begin(), session.received.end(), frame.begin(), frame.end()),
      session.received.end());
}

TEST(SimulatedCreate, HostMaySpeakSlowlyAfterOpcode129) {
  Session session;
  session.send({128, 129, 7});
  session.run(0.1);
  session.create.set_host_baud(19200);
  session.send({131});
  session.run(0.1);
  EXPECT_EQ(session.create.interface().mode(), OiMode::kSafe);
}

TEST(SimulatedCreate, StreamArrivesAtThePaceOfTheLine) {
  Session session;
  session.stream_everything();
  session.received.clear();
  session.run(1.0);
  EXPECT_NEAR(static_cast<double>(session.received.size()), 84.0 / 0.015, 84.0);
}

RC_GTEST_PROP(SimulatedCreate, SameSeedAndBytesGiveTheSameBits, (std::uint64_t seed)) {
  SimulatedCreate::Setup setup;
  setup.seed = seed;
  const auto run = [&] {
    Session session(setup);
    session.plan.walls = {{{0.5, -1.0}, {0.5, 1.0}}};
    session.send({128, 131, 148, 1, 100, 145, 0, 250, 0, 200});
    session.run(3.0);
    return std::pair{session.received, session.create.motion().pose().x_m};
  };
  RC_ASSERT(run() == run());
}

RC_GTEST_PROP(EncoderTicks, DifferencesAreExactAcrossEveryWrap, ()) {
  const int start = *rc::gen::inRange(-1'000'000, 1'000'000);
  const int delta = *rc::gen::inRange(-32767, 32768);
  const auto at = [](int ticks) { return encoder_ticks((ticks + 0.5) * kTravelPerTick_m); };
  const auto shown =
      static_cast<std::int16_t>(static_cast<std::uint16_t>(at(start + delta) - at(start)));
  RC_ASSERT(shown == delta);
}

TEST(EncoderTicks, CountWhatTheWheelsTurned) {
  Session session(exact());
  session.send({128, 132, 145, 1, 244, 1, 244});
  session.run(70.0);  // 35 m: the counters wrap after 29.1
  session.received.clear();
  session.send({149, 2, 43, 44});
  session.run(0.03);
  const double ticks = session.create.motion().wheels().left.turned_m / kTravelPerTick_m;
  EXPECT_GT(ticks, 70'000.0);
  EXPECT_NEAR(word_at(session.received, 0) & 0xFFFF, ticks - 65536.0, 60.0)
      << "as old as the last sensor period";
}

/// An engine of random bytes never brings the robot down.
RC_GTEST_PROP(SimulatedCreate, SurvivesAnyBytes, (const Bytes& bytes)) {
  for (const char* model : {"create1", "create2"}) {
    SimulatedCreate::Setup setup;
    setup.interface.model = model;
    Session session(setup);
    session.send({128});
    session.send(bytes);
    session.run(0.2);
    RC_ASSERT(session.create.motion().pose().position_m().allFinite());
  }
}

}  // namespace
}  // namespace roomwise::simulator
