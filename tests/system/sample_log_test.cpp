// The sample that comes with the project goes through every service, one after the other.
#include <gtest/gtest.h>

#include "tests/support/build_paths.h"
#include "tests/system/live_service.h"

namespace roomwise {
namespace {

const std::filesystem::path kSample = source_folder() / "logs/samples/living_room.lcmlog";

class SampleLogTest : public ::testing::Test {
 protected:
  /// The log of what `service` makes of `input`.
  std::string replayed(const std::string& service, const std::string& input) {
    const std::string output = folder_.path() / (service + ".lcmlog");
    EXPECT_EQ(run_to_end({program(service), "--replay", input, "--record", output}, said_), 0)
        << said_;
    return output;
  }

  ScratchFolder folder_;
  std::string said_;
};

TEST_F(SampleLogTest, IsSmallAndWhole) {
  EXPECT_LE(std::filesystem::file_size(kSample), 2'000'000U);
  EXPECT_EQ(run_to_end({program("rwlog"), "info", kSample}, said_), 0) << said_;
}

TEST_F(SampleLogTest, BecomesLandmarksLabelsAndAMap) {
  const std::string seen = replayed("landmark_svc", kSample);
  const std::string labelled = replayed("segment_svc", seen);
  const std::string mapped = replayed("ekf_svc", labelled);
  const std::size_t frames = events_on("KINECT_FRAME", mapped).size();
  EXPECT_EQ(frames, 81U);
  EXPECT_EQ(events_on("LANDMARKS", mapped).size(), frames);
  EXPECT_EQ(events_on("SEGMENTS", mapped).size(), frames);
  EXPECT_FALSE(events_on("LANDMARK_MAP", mapped).empty());
  EXPECT_GE(events_on("POSE", mapped).size(), events_on("ODOMETRY", mapped).size());
  EXPECT_EQ(run_to_end({program("rwlog"), "score", mapped}, said_), 0) << said_;
  for (const char* score : {"ate_aligned_m ", "floor_iou ", "landmarks_per_frame "}) {
    EXPECT_NE(said_.find(score), std::string::npos) << score << said_;
  }
}

}  // namespace
}  // namespace roomwise
