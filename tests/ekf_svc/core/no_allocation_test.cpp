// Nothing is allocated once the map has its landmarks: not to predict, associate, update, add,
// remove, merge or close a loop.
#include <gtest/gtest.h>

#include "services/ekf_svc/core/estimator.h"
#include "tests/ekf_svc/support/corridor_world.h"
#include "tests/support/allocation_counter.h"

namespace roomwise::ekf {
namespace {

TEST(Allocation, NoneAfterStartInTwoLapsOfACorridor) {
  EkfParams params;
  params.range_bias_m = params.lateral_bias_m = 0.0;
  CorridorWorld world({.spacing_m = 0.6}, 3);
  Slam slam(params);
  std::vector<Sighting> sightings;
  sightings.reserve(64);
  std::vector<Verdict> verdicts(64);
  int merged = 0;
  long allocated = 0;
  const int steps = static_cast<int>(2.0 * world.lap_m() / 0.1);
  for (int step = 0; step < steps; ++step) {
    const MotionIncrement motion = world.drive();
    sightings.clear();
    for (const CorridorWorld::Seen& seen : world.look()) sightings.push_back(seen.sighting);
    const long before = allocations_so_far();
    slam.predict(motion);
    merged += slam.process(sightings, true, std::span(verdicts).first(sightings.size())).merged;
    allocated += allocations_so_far() - before;
  }
  EXPECT_GT(slam.filter().landmark_count(), 150U);
  EXPECT_GT(merged, 0);
  EXPECT_EQ(allocated, 0);
}

}  // namespace
}  // namespace roomwise::ekf
