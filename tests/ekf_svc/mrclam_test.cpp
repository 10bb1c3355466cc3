// Real Create robots among 15 barcode posts: UTIAS MRCLAM data set 7, identities known.
#include "tests/ekf_svc/support/mrclam.h"

#include <gtest/gtest.h>

#include "common/bus/log_bus.h"
#include "common/bus/wire.h"
#include "services/ekf_svc/ekf_service.h"
#include "tests/support/shared_data.h"

namespace roomwise {
namespace {

struct Score {
  double trajectory_m = 0.0;
  double map_m = 0.0;
};

std::vector<LogEvent> replay(const mrclam::Run& run) {
  std::vector<LogEvent> output;
  LogBus bus(run.events, output);
  EkfService service(bus, {});
  bus.run();
  return output;
}

Score score(const mrclam::Run& run, const std::vector<LogEvent>& output) {
  std::vector<Eigen::Vector2d> path, true_path, map, true_map;
  landmark_map_t last_map{};
  for (const LogEvent& event : output) {
    pose_t pose;
    Pose2 truth;
    if (event.channel == channels::kPose.name && decode(event.data, pose) == DecodeResult::kOk &&
        mrclam::truth_at(run, pose.utime, truth)) {
      path.emplace_back(pose.x_m, pose.y_m);
      true_path.push_back(truth.position_m());
    }
    if (event.channel == channels::kLandmarkMap.name) {
      EXPECT_EQ(decode(event.data, last_map), DecodeResult::kOk);
    }
  }
  for (const map_landmark_t& landmark : last_map.map_landmarks) {
    map.emplace_back(landmark.map_x_m, landmark.map_y_m);
    true_map.push_back(run.landmarks.at(landmark.identity));
  }
  EXPECT_EQ(map.size(), 15U);
  return {mrclam::aligned_rmse(path, true_path), mrclam::aligned_rmse(map, true_map)};
}

class Mrclam : public testing::TestWithParam<int> {};

TEST_P(Mrclam, TrajectoryAndMapAreWithinTheBars) {
  ROOMWISE_NEED_DATA("mrclam7");
  const mrclam::Run run = mrclam::read(shared_data() / "mrclam7", GetParam());
  const Score result = score(run, replay(run));
  std::printf("robot %d: aligned trajectory RMSE %.3f m, aligned map RMSE %.3f m\n", GetParam(),
              result.trajectory_m, result.map_m);
  EXPECT_LE(result.trajectory_m, 0.15);
  EXPECT_LE(result.map_m, 0.085);
}

INSTANTIATE_TEST_SUITE_P(Set7, Mrclam, testing::Values(2, 5));

}  // namespace
}  // namespace roomwise
