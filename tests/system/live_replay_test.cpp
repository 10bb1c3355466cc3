// Real processes over real LCM in a private network: what a service publishes when lcm-logplayer
// plays a log to it at normal speed is, byte for byte, what it records when it replays the log
// offline.
#include <gtest/gtest.h>

#include <csignal>
#include <ostream>

#include "tests/support/private_network.h"
#include "tests/system/live_service.h"
#include "tests/system/made_logs.h"

namespace roomwise {
namespace {

struct Case {
  const char* service;
  std::vector<LogEvent> (*make_events)();
  std::vector<std::string> outputs;
  friend void PrintTo(const Case& c, std::ostream* out) { *out << c.service; }
};

class LiveReplayTest : public ::testing::TestWithParam<Case> {
 protected:
  static void SetUpTestSuite() { enter_private_network(); }

  /// Plays `log` to the live service and has the stock lcm-logger record everything.
  void record_live(const std::string& log, const std::string& record) {
    ChildProcess logger({"lcm-logger", "-q", "-f", std::string("--lcm-url=") + kTestUrl, record},
                        folder_.path() / "logger-output");
    LiveService service(GetParam().service);
    ASSERT_TRUE(service.wait_for_health([](const health_t&) { return true; })) << service.output();
    std::string said;
    ASSERT_EQ(run_to_end({"lcm-logplayer", std::string("--lcm-url=") + kTestUrl, log}, said), 0)
        << said;
    wait_until_all_is_handled(service, log);
    EXPECT_EQ(service.stop(SIGINT), 0) << service.output();
    logger.send_signal(SIGINT);
    EXPECT_EQ(logger.wait(), 0);
  }

  void wait_until_all_is_handled(LiveService& service, const std::string& log) {
    const auto input = GetParam().make_events();
    const std::string last_channel = input.back().channel;
    const auto expected = static_cast<std::int64_t>(events_on(last_channel, log).size());
    EXPECT_TRUE(service.wait_for_health([&](const health_t& health) {
      return channel_of(health, last_channel).received == expected;
    }));
  }

  ScratchFolder folder_;
};

TEST_P(LiveReplayTest, LiveEqualsOfflineByteForByte) {
  const std::string log = folder_.path() / "in.lcmlog";
  const std::string live = folder_.path() / "live.lcmlog";
  const std::string offline = folder_.path() / "offline.lcmlog";
  write_log(log, GetParam().make_events());

  record_live(log, live);
  std::string said;
  ASSERT_EQ(run_to_end({program(GetParam().service), "--replay", log, "--record", offline}, said),
            0)
      << said;

  for (const std::string& channel : GetParam().outputs) {
    const auto live_events = events_on(channel, live);
    const auto offline_events = events_on(channel, offline);
    EXPECT_GT(offline_events.size(), 0U) << channel;
    ASSERT_EQ(live_events.size(), offline_events.size()) << channel;
    for (std::size_t i = 0; i < live_events.size(); ++i) {
      ASSERT_EQ(live_events[i].data, offline_events[i].data) << channel << " message " << i;
    }
  }
}

TEST_P(LiveReplayTest, StopsCleanlyOnSigterm) {
  LiveService service(GetParam().service);
  ASSERT_TRUE(service.wait_for_health([](const health_t&) { return true; })) << service.output();
  EXPECT_EQ(service.stop(SIGTERM), 0);
}

INSTANTIATE_TEST_SUITE_P(Services, LiveReplayTest,
                         ::testing::Values(Case{"landmark_svc", made_frames, {"LANDMARKS"}},
                                           Case{"segment_svc", made_frames, {"SEGMENTS"}},
                                           Case{"ekf_svc", made_drive, {"POSE", "LANDMARK_MAP"}}),
                         [](const auto& instance) { return std::string(instance.param.service); });

}  // namespace
}  // namespace roomwise
