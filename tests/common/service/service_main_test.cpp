#include "common/service_main.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "common/bus/log_file.h"
#include "tests/support/events.h"
#include "tests/support/scratch_folder.h"

namespace roomwise {
namespace {

/// Publishes a POSE at scale_ratio times the odometry's x; x below 0 is bad data.
class ScaleService {
 public:
  struct Params {
    double scale_ratio = 2.0;
    template <class Field>
    void visit_fields(Field&& field) {
      field("scale_ratio", scale_ratio, 0.0, 10.0);
    }
  };
  ScaleService(Bus& bus, const Params& params) {
    bus.subscribe(channels::kOdometry, [&bus, params](const odometry_t& odometry) {
      if (odometry.x_m < 0.0) return bus.count("negative_x");
      pose_t pose{};
      pose.utime = odometry.utime;
      pose.x_m = params.scale_ratio * odometry.x_m;
      bus.publish(channels::kPose, pose);
    });
  }
};

/// Named as the service that owns POSE, so that the record must replace what a log has of it.
int run(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "ekf_svc");
  std::vector<const char*> argv;
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  return service_main<ScaleService>("ekf_svc", static_cast<int>(argv.size()), argv.data());
}

LogEvent odometry_event(std::int64_t utime, std::int64_t seq, double x_m) {
  odometry_t odometry{};
  odometry.utime = utime;
  odometry.seq = seq;
  odometry.x_m = x_m;
  return event_of(channels::kOdometry, utime, odometry);
}

std::string file_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<LogEvent> read_log(const std::filesystem::path& path) {
  LogReader reader(path);
  std::vector<LogEvent> events;
  for (LogEvent event; reader.next(event);) events.push_back(event);
  return events;
}

template <class Message>
std::vector<Message> messages(const std::filesystem::path& log, const Channel<Message>& channel) {
  std::vector<Message> found;
  for (const LogEvent& event : read_log(log)) {
    if (event.channel != channel.name) continue;
    EXPECT_EQ(decode(event.data, found.emplace_back()), DecodeResult::kOk);
  }
  return found;
}

class ServiceMainTest : public ::testing::Test {
 protected:
  ServiceMainTest() {
    LogWriter writer(in_);
    for (int i = 1; i <= 5; ++i) writer.write(odometry_event(i * 500'000, i, i));
    writer.close();
  }
  void append(const LogEvent& event) {
    const auto events = read_log(in_);
    LogWriter writer(in_);
    for (const LogEvent& old : events) writer.write(old);
    writer.write(event);
    writer.close();
  }
  int replay(std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"--replay", in_, "--record", out_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  void write_params(const std::string& text) { std::ofstream(params_) << text; }

  ScratchFolder folder_;
  std::string in_ = folder_.path() / "in.lcmlog";
  std::string out_ = folder_.path() / "out.lcmlog";
  std::string params_ = folder_.path() / "p.toml";
};

TEST_F(ServiceMainTest, RecordsInputAndOutputInterleaved) {
  EXPECT_EQ(replay(), 0);
  const auto events = read_log(out_);
  ASSERT_GE(events.size(), 2U);
  EXPECT_EQ(events[0], read_log(in_)[0]);
  EXPECT_EQ(events[1].channel, "POSE");
  EXPECT_EQ(messages(out_, channels::kPose).at(2).x_m, 6.0);
}

TEST_F(ServiceMainTest, ReplaysTwiceToTheSameBytes) {
  EXPECT_EQ(replay(), 0);
  const std::string first = file_text(out_);
  EXPECT_EQ(replay(), 0);
  EXPECT_EQ(file_text(out_), first);
}

TEST_F(ServiceMainTest, ReplayOfItsOwnRecordGivesTheSameBytes) {
  EXPECT_EQ(replay(), 0);
  const std::string first = file_text(out_);
  std::filesystem::rename(out_, in_);
  EXPECT_EQ(replay(), 0);
  EXPECT_EQ(file_text(out_), first);
}

TEST_F(ServiceMainTest, KeepsWhatOtherServicesSaidOfThemselves) {
  health_t other{};
  other.service = "landmark_svc";
  append(event_of(channels::kHealth, 2'600'000, other));
  EXPECT_EQ(replay(), 0);
  const auto healths = messages(out_, channels::kHealth);
  EXPECT_EQ(std::count_if(healths.begin(), healths.end(),
                          [](const health_t& h) { return h.service == "landmark_svc"; }),
            1);
}

TEST_F(ServiceMainTest, OutputsOnlyLeavesTheInputOut) {
  EXPECT_EQ(replay({"--outputs-only"}), 0);
  EXPECT_TRUE(messages(out_, channels::kOdometry).empty());
  EXPECT_EQ(messages(out_, channels::kPose).size(), 5U);
}

TEST_F(ServiceMainTest, PublishesHealthWithCountsOfBadData) {
  append(odometry_event(2'600'000, 9, -1.0));
  EXPECT_EQ(replay(), 0);
  const health_t last = messages(out_, channels::kHealth).back();
  EXPECT_EQ(last.service, "ekf_svc");
  ASSERT_EQ(last.counters.size(), 1U);
  EXPECT_EQ(last.counters[0].name, "negative_x");
  const auto odometry = std::find_if(last.channels.begin(), last.channels.end(),
                                     [](const auto& c) { return c.channel == "ODOMETRY"; });
  ASSERT_NE(odometry, last.channels.end());
  EXPECT_EQ(odometry->received, 6);
  EXPECT_EQ(odometry->missed, 3);
}

TEST_F(ServiceMainTest, PublishesTheParametersInForce) {
  write_params("scale_ratio = 3");
  EXPECT_EQ(replay({"--params", params_}), 0);
  EXPECT_EQ(messages(out_, channels::kPose).at(0).x_m, 3.0);
  EXPECT_EQ(messages(out_, channels::kParams).at(0).toml, "scale_ratio = 3.0\n");
}

TEST_F(ServiceMainTest, CommandLineOverridesTheParameterFile) {
  write_params("scale_ratio = 3");
  EXPECT_EQ(replay({"--params", params_, "--scale_ratio", "4"}), 0);
  EXPECT_EQ(messages(out_, channels::kPose).at(0).x_m, 4.0);
  EXPECT_EQ(replay({"--scale_ratio", "11"}), 1);
}

TEST_F(ServiceMainTest, RefusesBadParametersAndRecordsNothing) {
  write_params("scale_ratio = 11");
  EXPECT_EQ(replay({"--params", params_}), 1);
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(ServiceMainTest, DamagedLogKeepsWhatWasWholeAndFails) {
  std::filesystem::resize_file(in_, std::filesystem::file_size(in_) - 10);
  EXPECT_EQ(replay(), 1);
  EXPECT_EQ(messages(out_, channels::kPose).size(), 4U);
}

TEST_F(ServiceMainTest, UndecodableMessageFailsTheReplayButNotTheRest) {
  LogEvent cut = odometry_event(2'600'000, 6, 1.0);
  cut.data.pop_back();
  append(cut);
  EXPECT_EQ(replay(), 1);
  EXPECT_EQ(messages(out_, channels::kPose).size(), 5U);
}

TEST_F(ServiceMainTest, RefusesToRecordOverItsInput) {
  const std::string before = file_text(in_);
  EXPECT_EQ(run({"--replay", in_, "--record", in_}), 1);
  EXPECT_EQ(file_text(in_), before);
}

TEST_F(ServiceMainTest, RefusesCommandLinesThatMeanNothing) {
  EXPECT_NE(run({"--replay", folder_.path() / "none"}), 0);
  EXPECT_NE(run({"--record", out_}), 0);
  EXPECT_NE(run({"--replay", in_, "--url", "memq://"}), 0);
  EXPECT_NE(run({"--nonsense"}), 0);
  EXPECT_EQ(run({"--help"}), 0);
}

}  // namespace
}  // namespace roomwise
