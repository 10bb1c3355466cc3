// What must never be called accessible: low things on the floor, stairs down, mirrors, windows.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <map>

#include "services/segment_svc/core/segmenter.h"
#include "services/simulator/core/scene_solids.h"
#include "tests/segment_svc/support/simulated_views.h"
#include "tests/simulator/support/plain_scene.h"

namespace roomwise::segment {
namespace {

using LabelCounts = std::map<int, int>;

/// Labels of the pixels that `is_wanted` (given the pixel's index), as the segmenter has them after
/// a few frames.
LabelCounts labels_where(SimulatedViews& views, const Pose2& pose,
                         const simulator::CameraMount& mount,
                         const std::function<bool(std::size_t)>& is_wanted) {
  Segmenter segmenter(SegmentParams{});
  Segmentation result;
  for (int i = 0; i < 3; ++i) segmenter.segment(views.look(pose, mount).frame, result);
  LabelCounts counts;
  for (std::size_t i = 0; i < result.labels.size(); ++i) {
    if (is_wanted(i)) ++counts[result.labels[i]];
  }
  return counts;
}

double share(const LabelCounts& counts, int label) {
  double all = 0.0;
  for (const auto& [of, count] : counts) all += count;
  const auto found = counts.find(label);
  return found == counts.end() ? 0.0 : found->second / all;
}

void print(const char* what, double value, const LabelCounts& counts) {
  std::printf("%s %.2f:", what, value);
  for (const auto& [label, name] : {std::pair{0, "obstacle"},
                                    {50, "drop-off"},
                                    {100, "wall"},
                                    {200, "accessible"},
                                    {255, "unknown"}}) {
    std::printf(" %s %.3f", name, share(counts, label));
  }
  std::printf("\n");
}

TEST(Hazards, FourCentimetresOnTheFloorAreFoundAtOneAndAHalfMetres) {
  for (const double height_m : {0.25, 0.4, 0.7, 1.0, 1.4}) {
    simulator::PlainScene plain;
    plain.put_floor().put_wall(4.0);
    plain.put(simulator::box({1.5, -0.06, 0.0}, {1.6, 0.06, 0.04}));
    SimulatedViews views(plain.scene());
    views.set_width(640);
    const simulator::CameraMount mount{.z_m = height_m,
                                       .pitch_down_rad = height_m > 0.6 ? 0.6 : 0.1};
    const LabelCounts counts = labels_where(views, {}, mount, [&](std::size_t i) {
      return views.ideal().surface_class[i] ==
             static_cast<std::uint8_t>(simulator::SurfaceClass::kObstacle);
    });
    print("4 cm at 1.5 m, camera at", height_m, counts);
    EXPECT_GE(share(counts, kObstacle), 0.8);
  }
}

// The uppermost centimetres of the pit's sides lie within the floor's tolerance and are called
// floor.
TEST(Hazards, StairsDownAreADropOffSeenFromMoreThanAMetreAway) {
  SimulatedViews views("stairs");
  views.set_width(640);
  const Pose2 before_the_edge{.x_m = 2.5, .y_m = 3.4 - 1.2, .heading_rad = std::acos(0.0)};
  for (const double height_m : {0.3, 0.5, 0.7, 1.0, 1.4}) {
    const simulator::CameraMount mount{.z_m = height_m,
                                       .pitch_down_rad = height_m > 0.6 ? 0.5 : 0.2};
    const LabelCounts counts = labels_where(views, before_the_edge, mount, [&](std::size_t i) {
      const bool is_near = views.ideal().inverse_depth_per_m[i] * 3.4F > 1.0F;
      return is_near && views.last().is_misread[i] == 0 &&
             views.ideal().surface_class[i] ==
                 static_cast<std::uint8_t>(simulator::SurfaceClass::kDropOff);
    });
    print("stairs 1.2 m ahead, camera at", height_m, counts);
    EXPECT_LE(share(counts, kAccessible), 0.11);
    if (height_m >= 0.5) {
      EXPECT_GE(share(counts, kDropOff), 0.6);
    }
  }
}

/// A room 3 m deep with a pane on its far wall, from `low_m` up.
simulator::PlainScene room_with_pane(const simulator::Material& material, double low_m) {
  simulator::PlainScene plain;
  plain.put_floor().put_wall(3.0);
  plain.put(simulator::box({-4.0, -30.0, 0.0}, {-3.9, 30.0, 3.0}), simulator::SurfaceClass::kWall);
  plain.made_of(material).put(simulator::box({2.98, -0.5, low_m}, {2.99, 0.5, 1.9}));
  return plain;
}

LabelCounts labels_of_pane(const simulator::Material& material, double low_m, double height_m) {
  simulator::PlainScene plain = room_with_pane(material, low_m);
  SimulatedViews views(plain.scene());
  return labels_where(views, {}, {.z_m = height_m, .pitch_down_rad = 0.1}, [&](std::size_t i) {
    return views.ideal().material[i] == views.scene().materials.size() - 1;
  });
}

TEST(Hazards, MirrorsAndWindowsAreNeverAccessible) {
  for (const double low_m : {0.1, 0.5}) {
    for (const double height_m : {0.3, 0.6, 1.2}) {
      const LabelCounts mirror =
          labels_of_pane({.name = "mirror", .mirror = 0.95F}, low_m, height_m);
      print("mirror, camera at", height_m, mirror);
      EXPECT_EQ(share(mirror, kAccessible), 0.0) << low_m;
      const LabelCounts window =
          labels_of_pane({.name = "glass", .see_through = true}, low_m, height_m);
      print("window, camera at", height_m, window);
      EXPECT_EQ(share(window, kAccessible), 0.0) << low_m;
    }
  }
}

}  // namespace
}  // namespace roomwise::segment
