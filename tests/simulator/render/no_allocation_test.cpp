#include <gtest/gtest.h>

#include "services/simulator/render/simulated_kinect.h"
#include "tests/simulator/support/plain_scene.h"
#include "tests/support/allocation_counter.h"

namespace roomwise::simulator {
namespace {

constexpr int kFrames = 3;

PlainScene room() {
  PlainScene plain;
  plain.put_floor().put_wall(3.0).put(box({1.5, -0.2, 0.0}, {1.7, 0.2, 0.9}));
  plain.made_of({.name = "tiles", .pattern = Pattern::kChecker});
  plain.put(box({2.0, 0.3, 0.0}, {2.5, 0.8, 0.6}));
  plain.made_of({.name = "mirror", .mirror = 0.9F}).put(box({2.9, -1.0, 0.2}, {2.95, -0.4, 1.4}));
  plain.made_of({.name = "glass", .see_through = true});
  plain.put(box({2.9, 1.0, 0.2}, {2.95, 1.4, 1.4}));
  plain.scene().lamps.push_back({});
  return plain;
}

long allocations_of_frames(const Scene& scene, bool registered) {
  SimulatedKinect kinect(scene, {}, {}, 1);
  RgbdFrame frame;
  const KinectMode mode{.registered = registered};
  for (int i = 0; i < 2; ++i) kinect.capture(camera_pose(0.4), 0.03 * i, i, mode, frame);
  const long before = allocations_so_far();
  for (int i = 2; i < 2 + kFrames; ++i)
    kinect.capture(camera_pose(0.4, 0.1 * i), 0.03 * i, i, mode, frame);
  return allocations_so_far() - before;
}

TEST(SimulatedKinect, AllocatesNothingAfterTheFirstFrames) {
  PlainScene plain = room();
  EXPECT_EQ(allocations_of_frames(plain.scene(), true), 0);
  EXPECT_EQ(allocations_of_frames(plain.scene(), false), 0);
}

TEST(SimulatedKinect, EmbreeAllocatesAtMostTwiceAFrameToMoveWalkers) {
  PlainScene plain = room();
  plain.scene().walkers.push_back({.name = "man",
                                   .meshes = {box({-0.2, -0.2, 0.0}, {0.2, 0.2, 1.8}).mesh},
                                   .way_m = {{1.0, 0.0}, {2.0, 0.0}},
                                   .speed_mps = 1.0});
  EXPECT_LE(allocations_of_frames(plain.scene(), true), 2 * kFrames);
}

}  // namespace
}  // namespace roomwise::simulator
