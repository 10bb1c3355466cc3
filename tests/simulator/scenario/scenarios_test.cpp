// What every scenario in services/simulator/scenarios must offer.
#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

#include "services/simulator/core/ground_plan.h"
#include "services/simulator/scenario/scenario.h"

namespace roomwise::simulator {
namespace {

const std::filesystem::path kFolder =
    std::filesystem::path(ROOMWISE_SOURCE_DIR) / "services/simulator/scenarios";

class Scenarios : public testing::TestWithParam<std::string> {};

TEST_P(Scenarios, LoadsWithBothLoops) {
  const Scene scene = load_scenario(find_scenario(GetParam(), kFolder)).scene;
  EXPECT_EQ(scene.name, GetParam());
  ASSERT_NE(find_path(scene, "loop1"), nullptr);
  ASSERT_NE(find_path(scene, "loop2"), nullptr);
  EXPECT_EQ(find_path(scene, "loop1")->rounds, 1);
  EXPECT_EQ(find_path(scene, "loop2")->rounds, 2);
  EXPECT_GT(clearance_m(ground_plan(scene, 0.0), scene.start.position_m()), 0.27);
}

INSTANTIATE_TEST_SUITE_P(All, Scenarios, testing::Values("empty", "living_room"),
                         [](const auto& one) { return one.param; });

}  // namespace
}  // namespace roomwise::simulator
