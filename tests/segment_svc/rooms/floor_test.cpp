#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "services/segment_svc/core/segmenter.h"
#include "tests/segment_svc/support/simulated_views.h"

namespace roomwise::segment {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;

TEST(Explore, Table) {
  const char* scenario = std::getenv("SCN") ? std::getenv("SCN") : "living_room";
  SimulatedViews views(scenario);
  if (std::getenv("W")) views.set_width(std::atoi(std::getenv("W")));
  std::printf("%8s %6s %6s   %8s %8s   %8s %8s\n", "height_m", "down", "unk", "iou", "wrong", "iou*", "wrong*");
  for (const double height_m : {0.25, 0.4, 0.7, 1.0, 1.4}) {
    for (const double tilt_deg : {0.0, 2.0, 5.0}) {
      FloorCounts all, well;
      for (const Pose2& pose : views.poses(10)) {
        const simulator::CameraMount claimed{.z_m = height_m, .pitch_down_rad = (height_m > 0.6 ? 0.35 : 0.1)};
        simulator::CameraMount mount = claimed;
        mount.pitch_down_rad += tilt_deg * kDegree_rad;
        Segmenter segmenter(SegmentParams{});
        Segmentation result;
        const LabelledFrame& seen = views.look(pose, mount, claimed);
        segmenter.segment(seen.frame, result);
        all += count_floor(seen, result.labels);
        well += count_floor(seen, result.labels, Misread::kLeftOut);
      }
      std::printf("%8.2f %6.2f %6.1f   %8.4f %8.4f   %8.4f %8.4f\n", height_m, height_m > 0.6 ? 0.35 : 0.1, tilt_deg,
                  all.iou_ratio(), all.wrong_ratio(), well.iou_ratio(), well.wrong_ratio());
    }
  }
}

}  // namespace
}  // namespace roomwise::segment
