// A robot that is switched off and on again in a corridor it has mapped.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "common/bus/log_bus.h"
#include "common/bus/wire.h"
#include "services/ekf_svc/ekf_service.h"
#include "tests/ekf_svc/support/corridor_messages.h"
#include "tests/support/scratch_folder.h"

namespace roomwise {
namespace {

constexpr std::int64_t kBegin_us = 1'700'000'000'000'000;

ekf::CorridorWorld four_classes() {
  ekf::CorridorSettings settings;
  settings.classes = 4;
  return {settings, 7};
}

struct Session {
  std::vector<pose_t> poses;
  std::vector<landmark_map_t> maps;

  std::ptrdiff_t count(std::int8_t state) const {
    return std::count_if(poses.begin(), poses.end(),
                         [=](const pose_t& pose) { return pose.state == state; });
  }
  std::set<std::int64_t> last_ids() const {
    std::set<std::int64_t> ids;
    for (const map_landmark_t& landmark : maps.back().map_landmarks) ids.insert(landmark.map_id);
    return ids;
  }
};

class SavedMap : public testing::Test {
 protected:
  /// Switches the robot on, drives `way_m` and switches it off.
  Session drive(ekf::CorridorMessages& messages, double way_m, const char* mode = "map") {
    std::vector<LogEvent> input, output;
    const auto send = [&](const auto& channel, const auto& message) {
      input.push_back({time_from_utime(message.utime), std::string(channel.name), {}});
      encode(message, input.back().data);
    };
    for (int step = 0; 0.1 * step < way_m; ++step) {
      send(channels::kOdometry, messages.drive());
      send(channels::kLandmarks, messages.look());
    }
    LogBus bus(input, output);
    EkfService::Params params;
    params.map_path = (folder_.path() / "corridor.map").string();
    params.mode = mode;
    EkfService service(bus, params);
    bus.run();
    Session session;
    for (const LogEvent& event : output) {
      pose_t pose;
      landmark_map_t map;
      if (event.channel == channels::kPose.name && decode(event.data, pose) == DecodeResult::kOk) {
        session.poses.push_back(pose);
      }
      if (event.channel == channels::kLandmarkMap.name &&
          decode(event.data, map) == DecodeResult::kOk) {
        session.maps.push_back(map);
      }
    }
    return session;
  }

  ScratchFolder folder_;
};

TEST_F(SavedMap, ARobotThatWakesUpIsLostUntilItKnowsThePlaceThenGoesOnWithTheMap) {
  ekf::CorridorMessages messages(four_classes(), kBegin_us);
  const double lap_m = messages.world().lap_m();
  const Session first = drive(messages, 1.2 * lap_m);
  EXPECT_EQ(first.count(pose_t::STATE_LOST), 0);

  messages.world().start_anywhere();
  const Session second = drive(messages, 10.0);
  EXPECT_EQ(second.poses[10].state, pose_t::STATE_LOST);
  EXPECT_GT(second.poses[10].covariance_x_x_m2, 1e5);
  EXPECT_GT(second.count(pose_t::STATE_RELOCALISED), 0);
  EXPECT_EQ(second.poses.back().state, pose_t::STATE_TRACKING);
  EXPECT_LT(second.count(pose_t::STATE_LOST), 60);
  const auto before = first.last_ids(), after = second.last_ids();
  EXPECT_TRUE(std::includes(after.begin(), after.end(), before.begin(), before.end()));
  EXPECT_LT(after.size(), before.size() + 5);
}

TEST_F(SavedMap, ModeLocaliseLeavesTheMapAsItIs) {
  ekf::CorridorMessages messages(four_classes(), kBegin_us);
  const double lap_m = messages.world().lap_m();
  drive(messages, 1.2 * lap_m);
  const auto written = std::filesystem::last_write_time(folder_.path() / "corridor.map");
  messages.world().start_anywhere();
  const Session session = drive(messages, 25.0, "localise");
  EXPECT_EQ(session.poses.back().state, pose_t::STATE_TRACKING);
  EXPECT_LT(session.poses.back().covariance_x_x_m2, 0.25);
  const auto& first = session.maps.front().map_landmarks;
  const auto& last = session.maps.back().map_landmarks;
  ASSERT_EQ(first.size(), last.size());
  for (std::size_t l = 0; l < first.size(); ++l) {
    EXPECT_EQ(first[l].map_x_m, last[l].map_x_m);
    EXPECT_EQ(first[l].covariance_x_x_m2, last[l].covariance_x_x_m2);
  }
  EXPECT_EQ(std::filesystem::last_write_time(folder_.path() / "corridor.map"), written);
}

TEST_F(SavedMap, ModeLocaliseWithoutAMapIsABrokenSetUp) {
  ekf::CorridorMessages messages(four_classes(), kBegin_us);
  EXPECT_THROW(drive(messages, 1.0, "localise"), std::runtime_error);
}

TEST_F(SavedMap, ALostRobotNeverWritesOverTheMap) {
  ekf::CorridorMessages messages(four_classes(), kBegin_us);
  const double lap_m = messages.world().lap_m();
  drive(messages, 1.2 * lap_m);
  const auto size = std::filesystem::file_size(folder_.path() / "corridor.map");
  ekf::CorridorMessages elsewhere(ekf::CorridorWorld({.spacing_m = 1.7, .classes = 4}, 99),
                                  kBegin_us);
  const Session session = drive(elsewhere, 30.0);
  EXPECT_EQ(session.count(pose_t::STATE_LOST), static_cast<std::ptrdiff_t>(session.poses.size()));
  EXPECT_EQ(std::filesystem::file_size(folder_.path() / "corridor.map"), size);
}

}  // namespace
}  // namespace roomwise
