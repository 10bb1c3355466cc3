#include "services/pilot_svc/core/pilot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace roomwise::pilot {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

/// A pilot that stands still on a free floor, whatever it asks for.
class PilotTest : public testing::Test {
 protected:
  PilotTest() { pilot_.set_goal({.behaviour = Behaviour::kWander}); }

  Motion run(double for_s, bool odometry = true, bool view = true) {
    Motion motion;
    for (int i = 0; i < static_cast<int>(for_s * 20.0); ++i) {
      now_ += std::chrono::milliseconds(50);
      if (odometry) (void)pilot_.add_odometry({now_, {}, 0});
      if (view) (void)pilot_.add_view(now_, {-0.4, 0.02, free_m_, unknown_, nothing_});
      motion = pilot_.tick(now_);
    }
    return motion;
  }
  State state() const { return pilot_.report().state; }

  Time now_ = time_from_utime(1'000'000'000);
  std::vector<double> free_m_ = std::vector<double>(41, 2.5);
  std::vector<double> unknown_ = std::vector<double>(41, 0.0);
  const std::vector<double> nothing_ = std::vector<double>(41, 0.0);
  Pilot pilot_{PilotParams{}};
};

TEST_F(PilotTest, DrivesWhenItHasAllItNeeds) {
  EXPECT_GT(run(0.5).speed_mps, 0.1);
  EXPECT_EQ(state(), State::kDriving);
}

TEST_F(PilotTest, WaitsWithZeroForEachMissingInputAndThenFails) {
  EXPECT_EQ(run(1.0, true, false).speed_mps, 0.0);
  EXPECT_EQ(state(), State::kWaiting);
  EXPECT_STREQ(pilot_.report().waits_for, "waits for SEGMENTS");
  run(10.0, true, false);
  EXPECT_EQ(state(), State::kFailed);
  EXPECT_EQ(pilot_.report().failure, Failure::kNoSegments);
}

TEST_F(PilotTest, SilenceStopsItAndItGoesOnAfterwards) {
  EXPECT_GT(run(0.5).speed_mps, 0.1);
  EXPECT_EQ(run(0.6, true, false).speed_mps, 0.0);
  EXPECT_EQ(run(0.6, false, true).speed_mps, 0.0);
  EXPECT_STREQ(pilot_.report().waits_for, "waits for ODOMETRY");
  EXPECT_GT(run(0.5).speed_mps, 0.1);
}

TEST_F(PilotTest, AfterARefusalItTurnsWhereItMeansToGoBeforeItDrives) {
  pilot_.set_goal({.behaviour = Behaviour::kGoTo, .x_m = 2.0});
  const auto drive = [&](double for_s) {
    run(0.05);
    EXPECT_EQ(pilot_.add_pose(now_, {}, true), InputResult::kUsed);
    return run(for_s);
  };
  ASSERT_GT(drive(0.3).speed_mps, 0.1);
  pilot_.add_refusal({0.4, -0.15});
  const Motion motion = drive(0.1);
  ASSERT_GT(std::abs(pilot_.report().bearing_rad), 0.1);
  EXPECT_EQ(motion.speed_mps, 0.0);
  EXPECT_GT(motion.turn_rate_radps * pilot_.report().bearing_rad, 0.0);
  EXPECT_GT(drive(0.6).speed_mps, 0.05);  // it has not turned, but nobody refuses any more
}

TEST_F(PilotTest, GoToNeedsAPoseThatIsTracking) {
  pilot_.set_goal({.behaviour = Behaviour::kGoTo, .x_m = 1.0});
  EXPECT_EQ(run(0.5).speed_mps, 0.0);
  EXPECT_STREQ(pilot_.report().waits_for, "waits for POSE");
  ASSERT_EQ(pilot_.add_pose(now_, {}, false), InputResult::kUsed);
  EXPECT_EQ(run(0.05).speed_mps, 0.0);
  ASSERT_EQ(pilot_.add_pose(now_, {}, true), InputResult::kUsed);
  EXPECT_GT(run(0.1).speed_mps, 0.1);
}

TEST_F(PilotTest, BadInputChangesNothing) {
  run(0.5);
  now_ += std::chrono::milliseconds(50);
  EXPECT_EQ(pilot_.add_odometry({now_, {kNotANumber, 0.0, 0.0}, 0}), InputResult::kNotFinite);
  EXPECT_EQ(pilot_.add_odometry({now_ - std::chrono::milliseconds(80), {}, 0}),
            InputResult::kOutOfOrder);
  EXPECT_EQ(pilot_.add_pose(now_, {0.0, kNotANumber, 0.0}, true), InputResult::kNotFinite);
  EXPECT_EQ(pilot_.add_view(now_ + std::chrono::hours(1), {0.0, 0.1, free_m_, unknown_, nothing_}),
            InputResult::kNoOdometry);
  EXPECT_GT(run(0.05).speed_mps, 0.1);
}

TEST_F(PilotTest, AGoalThatCannotBeMeantFailsAtOnce) {
  pilot_.set_goal({.behaviour = Behaviour::kWander, .speed_mps = kNotANumber});
  EXPECT_EQ(run(0.5).speed_mps, 0.0);
  EXPECT_EQ(pilot_.report().failure, Failure::kBadGoal);
}

TEST_F(PilotTest, StopStops) {
  run(0.5);
  pilot_.set_goal({});
  EXPECT_EQ(run(0.05).speed_mps, 0.0);
  EXPECT_EQ(state(), State::kIdle);
}

TEST_F(PilotTest, WhoeverDoesNotGetOnRecoversAndInTheEndGivesUp) {
  run(6.0);
  EXPECT_EQ(state(), State::kRecovering);
  EXPECT_EQ(pilot_.report().recoveries, 1);
  run(300.0);
  EXPECT_EQ(state(), State::kFailed);
  EXPECT_EQ(pilot_.report().failure, Failure::kStuck);
  EXPECT_EQ(pilot_.report().recoveries, PilotParams{}.recoveries_max);
}

TEST_F(PilotTest, BacksOffFromWhatItTouched) {
  run(0.5);
  pilot_.set_hold(Hold::kTouched);
  EXPECT_LT(run(1.0).speed_mps, 0.0);
  EXPECT_EQ(state(), State::kRecovering);
}

TEST_F(PilotTest, HeldBySafetyItWaitsWithoutGivingUp) {
  pilot_.set_hold(Hold::kHeld);
  EXPECT_EQ(run(60.0).speed_mps, 0.0);
  EXPECT_EQ(state(), State::kWaiting);
  pilot_.set_hold(Hold::kNone);
  EXPECT_GT(run(0.1).speed_mps, 0.1);
}

TEST_F(PilotTest, IsDoneWhenItsTimeIsUp) {
  pilot_.set_goal({.behaviour = Behaviour::kWander, .duration_s = 1.0});
  run(0.5);
  EXPECT_NEAR(pilot_.report().progress.ratio, 0.5, 0.1);
  EXPECT_EQ(run(1.0).speed_mps, 0.0);
  EXPECT_EQ(state(), State::kDone);
}

TEST_F(PilotTest, CircleWithNothingInSightSaysSo) {
  pilot_.set_goal({.behaviour = Behaviour::kCircle});
  free_m_.assign(41, 5.0);
  double heading_rad = 0.0;
  for (int i = 0; i < 2000 && state() != State::kFailed; ++i) {
    now_ += std::chrono::milliseconds(50);
    ASSERT_EQ(pilot_.add_odometry({now_, {0.0, 0.0, heading_rad}, 0}), InputResult::kUsed);
    (void)pilot_.add_view(now_, {-0.4, 0.02, free_m_, unknown_, nothing_});
    heading_rad = wrap_angle(heading_rad + 0.05 * pilot_.tick(now_).turn_rate_radps);
  }
  EXPECT_EQ(pilot_.report().failure, Failure::kNoObject);
}

}  // namespace
}  // namespace roomwise::pilot
