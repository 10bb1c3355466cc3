#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <numbers>
#include <string>

#include "services/segment_svc/core/segmenter.h"
#include "tests/segment_svc/support/simulated_views.h"

namespace roomwise::segment {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;
constexpr int kPoses = 10;

/// A camera as high as that; a high one looks down more.
simulator::CameraMount mounted_at(double height_m) {
  return {.z_m = height_m, .pitch_down_rad = height_m > 0.6 ? 0.35 : 0.1};
}

struct FloorScores {
  FloorCounts all;
  FloorCounts well_read;  ///< without the pixels that the sensor misreads
};

/// Frames along the room's path, each one the first that the segmenter sees.
FloorScores score(SimulatedViews& views, double height_m, double unknown_tilt_rad) {
  const simulator::CameraMount claimed = mounted_at(height_m);
  simulator::CameraMount mount = claimed;
  mount.pitch_down_rad += unknown_tilt_rad;
  FloorScores scores;
  Segmentation result;
  for (const Pose2& pose : views.poses(kPoses)) {
    Segmenter segmenter(SegmentParams{});
    const LabelledFrame& seen = views.look(pose, mount, claimed);
    segmenter.segment(seen.frame, result);
    scores.all += count_floor(seen, result.labels);
    scores.well_read += count_floor(seen, result.labels, Misread::kLeftOut);
  }
  return scores;
}

class FloorInRooms : public testing::TestWithParam<std::string> {};

TEST_P(FloorInRooms, IsFoundFromAnyHeightWhateverTheTilt) {
  SimulatedViews views(GetParam());
  std::printf(
      "%s: camera height, unknown tilt; floor IoU, other called floor;\n"
      "  the same without pixels whose reading is of another surface\n",
      GetParam().c_str());
  for (const double height_m : {0.25, 0.4, 0.7, 1.0, 1.4}) {
    double level_iou_ratio = 0.0;
    for (const double tilt_deg : {0.0, 2.0, 5.0}) {
      const auto [all, well_read] = score(views, height_m, tilt_deg * kDegree_rad);
      std::printf("%5.2f m %2.0f deg  %.4f %.4f  %.4f %.4f\n", height_m, tilt_deg, all.iou_ratio(),
                  all.wrong_ratio(), well_read.iou_ratio(), well_read.wrong_ratio());
      if (tilt_deg == 0.0) level_iou_ratio = all.iou_ratio();
      EXPECT_GE(all.iou_ratio(), 0.95);
      EXPECT_GE(all.iou_ratio(), level_iou_ratio - 0.01);
      EXPECT_LE(all.wrong_ratio(), 0.005);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Rooms, FloorInRooms, testing::Values("living_room", "apartment"),
                         [](const auto& room) { return room.param; });

}  // namespace
}  // namespace roomwise::segment
