#include "services/create_driver/core/command_gate.h"

#include <gtest/gtest.h>

#include <limits>

namespace roomwise::create {
namespace {

using std::chrono::hours;
using std::chrono::milliseconds;

constexpr Time kWall = time_from_utime(1'700'000'000'000'000);
constexpr Duration kSteady = hours(3);

Instant after(Duration time) { return {kSteady + time, kWall + time}; }

VelocityCommand command_at(const Instant& now, std::int64_t sequence, std::int64_t session = 7) {
  return {.speed_mps = 0.2,
          .turn_rate_radps = 0.1,
          .decided = now.wall,
          .expiry = now.wall + milliseconds(200),
          .session = session,
          .sequence = sequence,
          .proof = Proof::kGenuine};
}

TEST(CommandGate, NothingIsInForceBeforeTheFirstCommand) {
  EXPECT_FALSE(CommandGate().in_force(after(Duration(0))));
}

TEST(CommandGate, ACommandIsObeyedFor200Milliseconds) {
  CommandGate gate;
  VelocityCommand command = command_at(after(Duration(0)), 1);
  command.expiry += hours(1);
  ASSERT_EQ(gate.offer(after(Duration(0)), command), std::nullopt);
  EXPECT_TRUE(gate.in_force(after(milliseconds(199))));
  EXPECT_FALSE(gate.in_force(after(milliseconds(200))));
}

TEST(CommandGate, ACommandsOwnExpiryMayBeSooner) {
  CommandGate gate;
  VelocityCommand command = command_at(after(Duration(0)), 1);
  command.expiry = kWall + milliseconds(50);
  ASSERT_EQ(gate.offer(after(Duration(0)), command), std::nullopt);
  EXPECT_TRUE(gate.in_force(after(milliseconds(49))));
  EXPECT_FALSE(gate.in_force(after(milliseconds(50))));
}

TEST(CommandGate, AClockSetBackDoesNotProlongACommand) {
  CommandGate gate;
  ASSERT_EQ(gate.offer(after(Duration(0)), command_at(after(Duration(0)), 1)), std::nullopt);
  EXPECT_FALSE(gate.in_force({kSteady + milliseconds(200), kWall - hours(1)}));
}

TEST(CommandGate, RefusesWhatIsNotSignedBeforeItLooksAtAnything) {
  const Instant now = after(Duration(0));
  for (const auto& [proof, why] : {std::pair(Proof::kMissing, DriverEvent::kCommandUnsigned),
                                   std::pair(Proof::kForged, DriverEvent::kCommandForged)}) {
    CommandGate gate;
    VelocityCommand command = command_at(now, 1);
    command.proof = proof;
    EXPECT_EQ(gate.offer(now, command), why);
    command.decided = kWall - hours(1);
    EXPECT_EQ(gate.offer(now, command), why);
    EXPECT_FALSE(gate.in_force(now));
    EXPECT_EQ(gate.offer(now, command_at(now, 1)), std::nullopt) << "its session was taken up";
  }
}

TEST(CommandGate, RefusesWhatIsNotFiniteOrAbsurd) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  for (const auto& [speed, rate, why] : {std::tuple(nan, 0.0, DriverEvent::kCommandNotFinite),
                                         std::tuple(0.0, nan, DriverEvent::kCommandNotFinite),
                                         std::tuple(-inf, 0.0, DriverEvent::kCommandNotFinite),
                                         std::tuple(0.0, inf, DriverEvent::kCommandNotFinite),
                                         std::tuple(1e300, 0.0, DriverEvent::kCommandAbsurd),
                                         std::tuple(0.0, -1e6, DriverEvent::kCommandAbsurd)}) {
    VelocityCommand command = command_at(after(Duration(0)), 1);
    command.speed_mps = speed;
    command.turn_rate_radps = rate;
    CommandGate gate;
    EXPECT_EQ(gate.offer(after(Duration(0)), command), why) << speed << " " << rate;
    EXPECT_FALSE(gate.in_force(after(Duration(0))));
  }
}

TEST(CommandGate, RefusesTheOldTheExpiredAndTheFuture) {
  const Instant now = after(Duration(0));
  VelocityCommand old = command_at(now, 1);
  old.decided = kWall - milliseconds(201);
  EXPECT_EQ(refusal_of(old, kWall), DriverEvent::kCommandExpired);
  VelocityCommand expired = command_at(now, 1);
  expired.expiry = kWall;
  EXPECT_EQ(refusal_of(expired, kWall), DriverEvent::kCommandExpired);
  VelocityCommand early = command_at(now, 1);
  early.decided = kWall + milliseconds(51);
  EXPECT_EQ(refusal_of(early, kWall), DriverEvent::kCommandFromFuture);
  early.decided = kWall + milliseconds(50);
  EXPECT_EQ(refusal_of(early, kWall), std::nullopt);
}

TEST(CommandGate, RefusesTimesAtTheEndsOfTheRange) {
  const std::int64_t last = std::numeric_limits<std::int64_t>::max();
  const std::int64_t first = std::numeric_limits<std::int64_t>::min();
  for (const std::int64_t decided : {last, first}) {
    for (const std::int64_t expiry : {last, first}) {
      VelocityCommand command = command_at(after(Duration(0)), 1);
      command.decided = time_from_utime(decided);
      command.expiry = time_from_utime(expiry);
      EXPECT_NE(refusal_of(command, kWall), std::nullopt);
    }
  }
}

TEST(CommandGate, InsideASessionTheSequenceMustGrow) {
  CommandGate gate;
  const Instant now = after(Duration(0));
  ASSERT_EQ(gate.offer(now, command_at(now, 5)), std::nullopt);
  EXPECT_EQ(gate.offer(now, command_at(now, 5)), DriverEvent::kCommandOutOfOrder);
  EXPECT_EQ(gate.offer(now, command_at(now, 4)), DriverEvent::kCommandOutOfOrder);
  EXPECT_EQ(gate.offer(now, command_at(now, 9)), std::nullopt);
  const Instant later = after(hours(1));
  EXPECT_EQ(gate.offer(later, command_at(later, 9)), DriverEvent::kCommandOutOfOrder);
}

TEST(CommandGate, OneSessionAtATime) {
  CommandGate gate;
  const Instant now = after(Duration(0));
  ASSERT_EQ(gate.offer(now, command_at(now, 100, 7)), std::nullopt);
  EXPECT_EQ(gate.offer(now, command_at(now, 1, 8)), DriverEvent::kCommandOtherSession);
  const Instant later = after(kCommandLife);
  EXPECT_EQ(gate.offer(later, command_at(later, 1, 8)), std::nullopt);
  EXPECT_EQ(gate.offer(later, command_at(later, 101, 7)), DriverEvent::kCommandOtherSession);
}

TEST(CommandGate, ARefusedCommandLeavesTheOneInForce) {
  CommandGate gate;
  const Instant now = after(Duration(0));
  ASSERT_EQ(gate.offer(now, command_at(now, 1)), std::nullopt);
  VelocityCommand bad = command_at(after(milliseconds(100)), 2);
  bad.speed_mps = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(gate.offer(after(milliseconds(100)), bad), std::nullopt);
  EXPECT_TRUE(gate.in_force(after(milliseconds(150))));
  EXPECT_FALSE(gate.in_force(after(milliseconds(250)))) << "a refused command prolongs nothing";
}

TEST(CommandGate, DroppedCommandsAreOverButNotForgotten) {
  CommandGate gate;
  const Instant now = after(Duration(0));
  ASSERT_EQ(gate.offer(now, command_at(now, 3)), std::nullopt);
  gate.drop();
  EXPECT_FALSE(gate.in_force(now));
  EXPECT_EQ(gate.offer(now, command_at(now, 3)), DriverEvent::kCommandOutOfOrder);
  EXPECT_EQ(gate.offer(now, command_at(now, 4)), std::nullopt);
  EXPECT_TRUE(gate.in_force(now));
}

}  // namespace
}  // namespace roomwise::create
