#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <numbers>

#include "services/segment_svc/core/segmenter.h"
#include "tests/segment_svc/support/simulated_views.h"

namespace roomwise::segment {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180.0;


void dump(const LabelledFrame& seen, const Segmentation& result, int i) {
  char name[100];
  std::snprintf(name, 100, "/tmp/seg_%d.ppm", i);
  FILE* f = std::fopen(name, "wb");
  std::fprintf(f, "P6\n%d %d\n255\n", seen.frame.depth.width_px, seen.frame.depth.height_px);
  for (std::size_t k = 0; k < result.labels.size(); ++k) {
    unsigned char c[3];
    const int l = result.labels[k], t = seen.truth[k];
    const int g = (seen.frame.color.rgb[3*k]+seen.frame.color.rgb[3*k+1]+seen.frame.color.rgb[3*k+2])/3;
    c[0]=c[1]=c[2]=(unsigned char)g;
    if (l == kAccessible) { c[1] = (unsigned char)(std::min(255, g/2+110)); }
    if (l == kWall) { c[2] = (unsigned char)(std::min(255, g/2+110)); }
    if (l == kUnknown) { c[0]=c[1]=c[2]=(unsigned char)(g/4); }
    if (t != kUnknown && t != kAccessible && l == kAccessible) { c[0]=255; c[1]=c[2]=0; }
    if (t == kAccessible && l != kAccessible) { c[0]=255; c[1]=255; c[2]=0; }
    std::fwrite(c, 1, 3, f);
  }
  std::fclose(f);
}

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
        if (std::getenv("H") && std::abs(height_m - std::atof(std::getenv("H"))) < 0.01 && tilt_deg == 0.0) { static int n = 0; dump(seen, result, n++); const auto c = count_floor(seen, result.labels); std::printf("%d %.4f %.4f\n", n-1, c.iou_ratio(), c.wrong_ratio()); }
        well += count_floor(seen, result.labels, Misread::kLeftOut);
      }
      std::printf("%8.2f %6.2f %6.1f   %8.4f %8.4f   %8.4f %8.4f\n", height_m, height_m > 0.6 ? 0.35 : 0.1, tilt_deg,
                  all.iou_ratio(), all.wrong_ratio(), well.iou_ratio(), well.wrong_ratio());
    }
  }
}

}  // namespace
}  // namespace roomwise::segment
