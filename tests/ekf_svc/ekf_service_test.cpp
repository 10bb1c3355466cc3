#include "services/ekf_svc/ekf_service.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "common/bus/log_bus.h"
#include "common/bus/wire.h"
#include "services/ekf_svc/ekf_messages.h"

namespace roomwise {
namespace {

constexpr std::int64_t kStart_us = 1'700'000'000'000'000;
constexpr std::int64_t kTick_us = 20'000;

odometry_t odometry_at(int tick) {
  odometry_t message{};
  message.utime = kStart_us + tick * kTick_us;
  message.seq = tick;
  message.interval_us = kTick_us;
  message.distance_increment_m = 0.01;
  message.covariance_distance_distance_m2 = 1e-6;
  message.covariance_turn_turn_rad2 = 1e-6;
  message.x_m = 0.01 * tick;
  return message;
}

landmark_observation_t sighting(int identity, double range_m, double bearing_rad) {
  landmark_observation_t seen{};
  seen.identity = identity;
  seen.kind = landmark_observation_t::KIND_FIDUCIAL;
  seen.range_m = range_m;
  seen.bearing_rad = bearing_rad;
  seen.covariance_range_range_m2 = 1e-3;
  seen.covariance_bearing_bearing_rad2 = 1e-3;
  seen.chroma_variance_log2 = 1e6;
  return seen;
}

landmark_list_t landmarks_at(std::int64_t utime, std::vector<landmark_observation_t> seen) {
  landmark_list_t message{};
  message.utime = utime;
  message.count = static_cast<std::int32_t>(seen.size());
  message.landmarks = std::move(seen);
  return message;
}

class EkfServiceTest : public testing::Test {
 protected:
  template <class Message>
  void send(const Channel<Message>& channel, const Message& message) {
    LogEvent event{
        Time{Duration(static_cast<std::int64_t>(input_.size()))}, std::string(channel.name), {}};
    encode(message, event.data);
    input_.push_back(std::move(event));
  }
  void send_odometry(int first, int last) {
    for (int tick = first; tick <= last; ++tick) send(channels::kOdometry, odometry_at(tick));
  }
  /// What the service made of everything sent so far.
  std::vector<LogEvent> run(const EkfService::Params& params = {}) {
    std::vector<LogEvent> output;
    LogBus bus(input_, output);
    EkfService service(bus, params);
    bus.run();
    counters_ = bus.statistics().counters;
    return output;
  }
  template <class Message>
  static std::vector<Message> all(const Channel<Message>& channel,
                                  const std::vector<LogEvent>& events) {
    std::vector<Message> messages;
    for (const LogEvent& event : events) {
      if (event.channel != channel.name) continue;
      messages.emplace_back();
      if (decode(event.data, messages.back()) != DecodeResult::kOk)
        throw std::logic_error("decode");
    }
    return messages;
  }
  std::int64_t counted(const char* what) const {
    const auto found = counters_.find(what);
    return found == counters_.end() ? 0 : found->second;
  }

  std::vector<LogEvent> input_;
  std::map<std::string, std::int64_t, std::less<>> counters_;
};

TEST(EkfMessages, OnlyIntegratedSpeedsWereAskedFor) {
  odometry_t message = odometry_at(1);
  message.source = odometry_t::SOURCE_WHEELS;
  EXPECT_FALSE(to_sample(message).is_asked_for);
  message.source = odometry_t::SOURCE_BODY;
  EXPECT_FALSE(to_sample(message).is_asked_for);
  message.source = odometry_t::SOURCE_VELOCITY;
  EXPECT_TRUE(to_sample(message).is_asked_for);
}

TEST_F(EkfServiceTest, OnePosePerOdometryAtItsTime) {
  send_odometry(1, 10);
  const auto poses = all(channels::kPose, run());
  ASSERT_EQ(poses.size(), 10U);
  EXPECT_EQ(poses.back().utime, kStart_us + 10 * kTick_us);
  EXPECT_NEAR(poses.back().x_m, 0.09, 1e-12);
  EXPECT_EQ(poses.back().state, pose_t::STATE_TRACKING);
  EXPECT_EQ(poses.back().nis_dof, 0);
  EXPECT_GT(poses.back().covariance_x_x_m2, 0.0);
}

TEST_F(EkfServiceTest, PoseSaysWhatTheLastFrameDid) {
  send_odometry(1, 10);
  send(channels::kLandmarks,
       landmarks_at(kStart_us + 10 * kTick_us, {sighting(1, 2.0, 0.1), sighting(2, 3.0, -0.2)}));
  send_odometry(11, 20);
  send(channels::kLandmarks,
       landmarks_at(kStart_us + 20 * kTick_us,
                    {sighting(1, 1.9, 0.1), sighting(2, 2.9, -0.2), sighting(3, -1.0, 0.0)}));
  send_odometry(21, 21);
  const auto poses = all(channels::kPose, run());
  EXPECT_EQ(poses[10].landmarks_added, 2);
  EXPECT_EQ(poses[10].landmarks_in_map, 2);
  EXPECT_EQ(poses[20].landmarks_seen, 3);
  EXPECT_EQ(poses[20].landmarks_matched, 2);
  EXPECT_EQ(poses[20].landmarks_rejected, 1);
  EXPECT_EQ(poses[20].nis_dof, 4);
  EXPECT_EQ(counted("sighting_range_invalid"), 1);
}

TEST_F(EkfServiceTest, MapComesOncePerSecondAndWhenItGrows) {
  send_odometry(1, 100);  // two seconds
  send(channels::kLandmarks, landmarks_at(kStart_us + 100 * kTick_us, {sighting(1, 2.0, 0.1)}));
  const auto maps = all(channels::kLandmarkMap, run());
  ASSERT_EQ(maps.size(), 4U);  // at the first odometry, at each whole second, and the landmark
  EXPECT_EQ(maps[1].utime, kStart_us + 1'000'000);
  EXPECT_EQ(maps[2].map_count, 0);
  ASSERT_EQ(maps[3].map_count, 1);
  EXPECT_EQ(maps[3].map_landmarks[0].identity, 1);
  EXPECT_EQ(maps[3].map_landmarks[0].times_seen, 1);
}

TEST_F(EkfServiceTest, FramesAreUsedInOrderOfTheirTimeHoweverTheyCome) {
  const auto first = landmarks_at(kStart_us + 12 * kTick_us, {sighting(1, 2.0, 0.1)});
  const auto second = landmarks_at(kStart_us + 14 * kTick_us, {sighting(1, 1.98, 0.1)});
  send_odometry(1, 10);
  send(channels::kLandmarks, second);
  send(channels::kLandmarks, first);
  send_odometry(11, 20);
  const auto swapped = all(channels::kPose, run()).back();
  input_.clear();
  send_odometry(1, 20);
  send(channels::kLandmarks, first);
  send(channels::kLandmarks, second);
  send_odometry(21, 21);
  auto ordered = all(channels::kPose, run()).back();
  EXPECT_EQ(swapped.landmarks_matched, 1);
  EXPECT_EQ(ordered.landmarks_matched, 1);
  EXPECT_NEAR(ordered.x_m - 0.01, swapped.x_m, 1e-7);  // one report more
  EXPECT_NEAR(ordered.y_m, swapped.y_m, 1e-6);
}

TEST_F(EkfServiceTest, LateRepeatedAndForeignFramesAreCounted) {
  send(channels::kLandmarks, landmarks_at(kStart_us, {sighting(1, 2.0, 0.1)}));
  send_odometry(1, 100);
  const auto frame = landmarks_at(kStart_us + 100 * kTick_us, {sighting(1, 2.0, 0.1)});
  send(channels::kLandmarks, frame);
  send(channels::kLandmarks, frame);
  send(channels::kLandmarks, landmarks_at(kStart_us + 99 * kTick_us, {sighting(1, 2.0, 0.1)}));
  send(channels::kLandmarks, landmarks_at(std::numeric_limits<std::int64_t>::max(), {}));
  send(channels::kLandmarks, landmarks_at(std::numeric_limits<std::int64_t>::min(), {}));
  run();
  EXPECT_EQ(counted("frame_before_odometry"), 1);
  EXPECT_EQ(counted("frame_duplicate"), 1);
  EXPECT_EQ(counted("frame_late"), 2);
  EXPECT_EQ(counted("frame_ahead_of_odometry"), 1);
}

TEST_F(EkfServiceTest, TenThousandLandmarksAtOnceFillTheBudgetAndNoMore) {
  send_odometry(1, 10);
  std::vector<landmark_observation_t> seen;
  for (int i = 0; i < 10'000; ++i) seen.push_back(sighting(i, 1.0 + 0.001 * i, 1e-4 * i));
  send(channels::kLandmarks, landmarks_at(kStart_us + 10 * kTick_us, seen));
  send_odometry(11, 12);
  const auto output = run();
  EXPECT_EQ(all(channels::kLandmarkMap, output).back().map_count, 2000);
  EXPECT_EQ(counted("sighting_budget_full"), 8000);
  EXPECT_EQ(all(channels::kPose, output).back().landmarks_in_map, 2000);
}

TEST_F(EkfServiceTest, SameInputGivesTheSameBytes) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> noise(0.0, 0.02);
  for (int tick = 1; tick <= 400; ++tick) {
    send(channels::kOdometry, odometry_at(tick));
    if (tick % 3 != 0) continue;
    std::vector<landmark_observation_t> seen;
    for (int i = 0; i < 6; ++i)
      seen.push_back(sighting(i % 2 == 0 ? i : -1, 2.0 + 0.5 * i + noise(engine),
                              0.2 * i - 0.5 + noise(engine)));
    send(channels::kLandmarks, landmarks_at(kStart_us + tick * kTick_us - 7'000, seen));
  }
  const auto once = run();
  const auto twice = run();
  ASSERT_EQ(once.size(), twice.size());
  for (std::size_t i = 0; i < once.size(); ++i) ASSERT_EQ(once[i].data, twice[i].data) << i;
}

/// Overwrites a few fields with what an attacker or a broken sender would choose.
class Spoiler {
 public:
  explicit Spoiler(std::uint64_t seed) : engine_(seed) {}
  double number() {
    constexpr double kInf = std::numeric_limits<double>::infinity();
    constexpr double kValues[] = {std::numeric_limits<double>::quiet_NaN(),
                                  kInf,
                                  -kInf,
                                  0.0,
                                  -1.0,
                                  1e300,
                                  -1e300,
                                  1e-300,
                                  1e6,
                                  5e-324};
    return kValues[engine_() % std::size(kValues)];
  }
  std::int64_t integer() {
    constexpr std::int64_t kValues[] = {std::numeric_limits<std::int64_t>::min(),
                                        std::numeric_limits<std::int64_t>::max(),
                                        0,
                                        -1,
                                        kStart_us,
                                        4'000'000'000'000'000'000};
    return kValues[engine_() % std::size(kValues)];
  }
  bool one_in(unsigned n) { return engine_() % n == 0; }
  void spoil(odometry_t& m) {
    for (double* field : {&m.distance_increment_m, &m.turn_increment_rad,
                          &m.covariance_distance_distance_m2, &m.covariance_distance_turn_m_rad,
                          &m.covariance_turn_turn_rad2, &m.x_m, &m.y_m, &m.heading_rad}) {
      if (one_in(6)) *field = number();
    }
    if (one_in(6)) m.utime = integer();
    if (one_in(6)) m.interval_us = integer();
    if (one_in(6)) m.reset_counter = static_cast<std::int32_t>(engine_());
  }
  void spoil(landmark_observation_t& m) {
    for (double* field : {&m.range_m, &m.bearing_rad, &m.covariance_range_range_m2,
                          &m.covariance_range_bearing_m_rad, &m.covariance_bearing_bearing_rad2,
                          &m.chroma_red_log, &m.chroma_blue_log, &m.chroma_variance_log2}) {
      if (one_in(6)) *field = number();
    }
    if (one_in(4)) m.identity = static_cast<std::int32_t>(engine_());
    if (one_in(4)) m.kind = static_cast<std::int8_t>(engine_());
  }

 private:
  std::mt19937_64 engine_;
};

bool is_sound(const pose_t& pose) {
  return std::isfinite(pose.x_m) && std::isfinite(pose.y_m) && std::isfinite(pose.heading_rad) &&
         std::isfinite(pose.nis_ratio) && pose.covariance_x_x_m2 > 0.0 &&
         pose.covariance_y_y_m2 > 0.0 && pose.covariance_heading_heading_rad2 > 0.0 &&
         std::isfinite(pose.covariance_x_x_m2 + pose.covariance_y_y_m2 +
                       pose.covariance_heading_heading_rad2);
}

TEST_F(EkfServiceTest, HostileMessagesNeitherCrashNorReachTheState) {
  Spoiler spoiler(42);
  for (int tick = 1; tick <= 3000; ++tick) {
    odometry_t odometry = odometry_at(tick);
    if (spoiler.one_in(3)) spoiler.spoil(odometry);
    send(channels::kOdometry, odometry);
    landmark_list_t list =
        landmarks_at(odometry_at(tick).utime, {sighting(1, 2.0, 0.3), sighting(-1, 3.0, -0.3)});
    for (landmark_observation_t& seen : list.landmarks) {
      if (spoiler.one_in(2)) spoiler.spoil(seen);
    }
    if (spoiler.one_in(9)) list.utime = spoiler.integer();
    send(channels::kLandmarks, list);
  }
  const auto output = run();
  const auto poses = all(channels::kPose, output);
  ASSERT_GT(poses.size(), 1000U);
  for (const pose_t& pose : poses) ASSERT_TRUE(is_sound(pose)) << pose.utime;
  EXPECT_GT(counted("odometry_not_finite"), 0);
  EXPECT_GT(counted("odometry_time_invalid"), 0);
  EXPECT_GT(counted("sighting_not_finite"), 0);
  EXPECT_GT(counted("sighting_covariance_invalid"), 0);
}

}  // namespace
}  // namespace roomwise
