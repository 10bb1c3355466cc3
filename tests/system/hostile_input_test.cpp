// Whatever arrives on the bus or stands in a log, a service counts it, says so on HEALTH, and goes
// on.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <limits>
#include <ostream>
#include <random>

#include "tests/support/events.h"
#include "tests/support/private_network.h"
#include "tests/system/datagram_sender.h"
#include "tests/system/live_service.h"
#include "tests/system/made_logs.h"

namespace roomwise {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Case {
  const char* service;
  const char* channel;
  std::vector<LogEvent> (*make_events)();
  friend void PrintTo(const Case& c, std::ostream* out) { *out << c.service << " " << c.channel; }
};

std::vector<LogEvent> events_of_case(const Case& test_case) {
  std::vector<LogEvent> events;
  for (LogEvent& event : test_case.make_events()) {
    if (event.channel == test_case.channel) events.push_back(std::move(event));
  }
  return events;
}

Bytes cut(Bytes bytes, std::size_t size) {
  bytes.resize(size);
  return bytes;
}

Bytes with_flipped_bits(Bytes bytes, int flips, std::minstd_rand& random) {
  for (int i = 0; i < flips; ++i) {
    const std::size_t bit = random() % (8 * bytes.size());
    bytes[bit / 8] = static_cast<std::uint8_t>(bytes[bit / 8] ^ (1U << (bit % 8)));
  }
  return bytes;
}

Bytes random_bytes(std::size_t size, std::minstd_rand& random) {
  Bytes bytes(size);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random() >> 8U);
  return bytes;
}

/// Messages that are not, or not quite, what `valid` is.
std::vector<Bytes> hostile_variants(const Bytes& valid) {
  std::minstd_rand random(7);
  std::vector<Bytes> variants = {{}, {0}, Bytes(8, 0xFF)};
  for (std::size_t i = 0; i < 20; ++i) variants.push_back(cut(valid, valid.size() * i / 20));
  variants.push_back(valid);
  variants.back().push_back(0);
  for (int i = 0; i < 100; ++i) variants.push_back(with_flipped_bits(valid, 1 + i / 10, random));
  for (std::size_t i = 0; i < 20; ++i) variants.push_back(random_bytes(40 * i, random));
  return variants;
}

/// `valid` with each stretch of eight bytes in its first kilobyte replaced by numbers that make
/// trouble, wherever a field may stand.
std::vector<Bytes> absurd_variants(const Bytes& valid) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<Bytes> variants;
  for (std::size_t at = 8; at + 8 <= std::min<std::size_t>(valid.size(), 1024); ++at) {
    for (const double value : {std::nan(""), kInfinity, -kInfinity, 1e308, -1e308, -1.0, 0.0}) {
      Bytes& bytes = variants.emplace_back(valid);
      const auto bits = std::bit_cast<std::uint64_t>(value);
      for (std::size_t i = 0; i < 8; ++i) {
        bytes[at + i] = static_cast<std::uint8_t>(bits >> (8 * (7 - i)));
      }
    }
  }
  return variants;
}

class HostileDatagramTest : public ::testing::TestWithParam<Case> {
 protected:
  static void SetUpTestSuite() { enter_private_network(); }
};

TEST_P(HostileDatagramTest, AreCountedAndTheServiceGoesOn) {
  LiveService service(GetParam().service);
  ASSERT_TRUE(service.wait_for_health([](const health_t&) { return true; })) << service.output();
  const auto events = events_of_case(GetParam());
  DatagramSender sender;
  for (const Bytes& bytes : malformed_lcm_packets()) sender.send_raw(bytes);
  for (const Bytes& bytes : hostile_variants(events[0].data)) {
    sender.send(GetParam().channel, bytes);
  }
  sender.send(GetParam().channel, event_of(channels::kTruth, 0, truth_t{}).data);
  const auto before = service.wait_for_health([&](const health_t& health) {
    return channel_of(health, GetParam().channel).undecodable >= 30;
  });
  ASSERT_TRUE(before) << service.output();

  for (const LogEvent& event : events) sender.send(GetParam().channel, event.data);
  EXPECT_TRUE(service.wait_for_health([&](const health_t& health) {
    return channel_of(health, GetParam().channel).received >
           channel_of(*before, GetParam().channel).received;
  })) << service.output();
  EXPECT_EQ(service.stop(SIGINT), 0) << service.output();
}

class HostileLogTest : public ::testing::TestWithParam<Case> {
 protected:
  int replay(const std::vector<LogEvent>& events) {
    write_log(log_, events);
    return run_to_end({program(GetParam().service), "--replay", log_, "--record", record_}, said_);
  }
  health_t last_health() {
    health_t health;
    EXPECT_EQ(decode(events_on("HEALTH", record_).back().data, health), DecodeResult::kOk);
    return health;
  }
  ScratchFolder folder_;
  std::string log_ = folder_.path() / "in.lcmlog";
  std::string record_ = folder_.path() / "out.lcmlog";
  std::string said_;
};

TEST_P(HostileLogTest, UndecodableMessagesFailTheReplayAndAreCounted) {
  auto events = events_of_case(GetParam());
  const LogEvent valid = events[0];
  for (const Bytes& bytes : hostile_variants(valid.data)) {
    events.push_back(valid);
    events.back().data = bytes;
  }
  EXPECT_EQ(replay(events), 1) << said_;
  EXPECT_GE(channel_of(last_health(), GetParam().channel).undecodable, 30);
}

TEST_P(HostileLogTest, AbsurdNumbersAreCountedAndNeverLeaveTheService) {
  auto events = GetParam().make_events();
  const LogEvent valid = events_of_case(GetParam())[0];
  for (const Bytes& bytes : absurd_variants(valid.data)) {
    events.push_back(valid);
    events.back().data = bytes;
  }
  for (const LogEvent& event : GetParam().make_events()) events.push_back(event);
  const int status = replay(events);
  EXPECT_TRUE(status == 0 || status == 1) << status << "\n" << said_;  // 1: a length made no sense
  EXPECT_FALSE(last_health().counters.empty()) << said_;
  for (const LogEvent& event : events_on("POSE", record_)) {
    pose_t pose;
    ASSERT_EQ(decode(event.data, pose), DecodeResult::kOk);
    ASSERT_TRUE(std::isfinite(pose.x_m + pose.y_m + pose.heading_rad + pose.covariance_x_x_m2 +
                              pose.covariance_y_y_m2 + pose.covariance_heading_heading_rad2));
  }
}

TEST_P(HostileLogTest, ALogCutAnywhereGivesWhatWasWholeAndFails) {
  write_log(log_, GetParam().make_events());
  const auto size = std::filesystem::file_size(log_);
  for (const std::uintmax_t cut_bytes : {std::uintmax_t{1}, size / 3 + 1, size - 10}) {
    write_log(log_, GetParam().make_events());
    std::filesystem::resize_file(log_, size - cut_bytes);
    const int status =
        run_to_end({program(GetParam().service), "--replay", log_, "--record", record_}, said_);
    EXPECT_EQ(status, 1);
    EXPECT_NE(said_.find("damaged at byte"), std::string::npos) << said_;
  }
}

constexpr auto kCases = [] {
  return ::testing::Values(Case{"landmark_svc", "KINECT_FRAME", made_frames},
                           Case{"segment_svc", "KINECT_FRAME", made_frames},
                           Case{"ekf_svc", "ODOMETRY", made_drive},
                           Case{"ekf_svc", "LANDMARKS", made_drive});
};
constexpr auto kName = [](const auto& info) {
  return std::string(info.param.service) + "_" + info.param.channel;
};
INSTANTIATE_TEST_SUITE_P(Services, HostileDatagramTest, kCases(), kName);
INSTANTIATE_TEST_SUITE_P(Services, HostileLogTest, kCases(), kName);

}  // namespace
}  // namespace roomwise
