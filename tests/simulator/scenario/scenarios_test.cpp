// What every scenario in services/simulator/scenarios must offer.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "services/simulator/core/ground_plan.h"
#include "services/simulator/core/path_plan.h"
#include "services/simulator/scenario/scenario.h"
#include "tests/simulator/scenario/visible_landmarks.h"
#include "tests/support/build_paths.h"

namespace roomwise::simulator {
namespace {

constexpr double kRobotRadius_m = 0.17;
constexpr double kMargin_m = 0.10;

Scene scene_named(const std::string& name) {
  const std::filesystem::path folder = source_folder() / "services/simulator/scenarios";
  return load_scenario(find_scenario(name, folder)).scene;
}

/// A scene whose walkers are gone.
Scene at_rest(Scene scene) {
  scene.walkers.clear();
  return scene;
}

class Scenarios : public testing::TestWithParam<std::string> {
 protected:
  const Scene scene_ = scene_named(GetParam());
};

TEST_P(Scenarios, OffersOneRoundAndTwo) {
  EXPECT_EQ(scene_.name, GetParam());
  ASSERT_NE(find_path(scene_, "loop1"), nullptr);
  ASSERT_NE(find_path(scene_, "loop2"), nullptr);
  EXPECT_EQ(find_path(scene_, "loop1")->rounds, 1);
  EXPECT_EQ(find_path(scene_, "loop2")->rounds, 2);
  EXPECT_EQ(find_path(scene_, "loop1")->corners_m, find_path(scene_, "loop2")->corners_m);
}

TEST_P(Scenarios, LeaveRoomForTheRobotAllAlongTheLoop) {
  const DrivePlan loop(scene_.start, *find_path(scene_, "loop1"));
  // What the camera on its mast must pass under is as much in the way as what the body meets.
  const GroundPlan plan = ground_plan(at_rest(scene_), 0.0, scene_.camera.z_m + 0.1);
  for (double t_s = 0.0; t_s < loop.duration_s(); t_s += 0.1) {
    const Eigen::Vector2d p_m = loop.at(t_s).pose.position_m();
    ASSERT_GE(clearance_m(plan, p_m), kRobotRadius_m + kMargin_m)
        << "at " << t_s << " s: " << p_m.transpose();
  }
}

TEST_P(Scenarios, KeepWalkersAwayFromTheRobotOnBothLoops) {
  for (const char* name : {"loop1", "loop2"}) {
    const DrivePlan loop(scene_.start, *find_path(scene_, name));
    for (double t_s = 0.0; t_s < loop.duration_s() + 5.0; t_s += 0.05) {
      const Eigen::Vector2d p_m = loop.at(t_s).pose.position_m();
      for (const Walker& walker : scene_.walkers) {
        const double apart_m = (walker_pose(walker, t_s).position_m() - p_m).norm();
        ASSERT_GE(apart_m, kRobotRadius_m + walker.radius_m + kMargin_m)
            << walker.name << " at " << t_s << " s of " << name;
      }
    }
  }
}

TEST_P(Scenarios, KeepWalkersOutOfThingsAndOfOneAnother) {
  const GroundPlan plan = ground_plan(at_rest(scene_), 0.0, 2.0);
  for (double t_s = 0.0; t_s < 300.0 && !scene_.walkers.empty(); t_s += 0.1) {
    for (std::size_t i = 0; i < scene_.walkers.size(); ++i) {
      const Eigen::Vector2d p_m = walker_pose(scene_.walkers[i], t_s).position_m();
      ASSERT_GE(clearance_m(plan, p_m), scene_.walkers[i].radius_m) << scene_.walkers[i].name;
      for (std::size_t j = 0; j < i; ++j) {
        ASSERT_GE((walker_pose(scene_.walkers[j], t_s).position_m() - p_m).norm(), 0.5)
            << scene_.walkers[i].name << " and " << scene_.walkers[j].name;
      }
    }
  }
}

TEST_P(Scenarios, ShowLandmarksMostOfTheTime) {
  if (GetParam() == "empty") {
    EXPECT_TRUE(scene_.landmarks.empty());
    return;
  }
  const DrivePlan loop(scene_.start, *find_path(scene_, "loop1"));
  std::vector<std::size_t> counts;
  for (double t_s = 0.0; t_s < loop.duration_s(); t_s += 0.5) {
    counts.push_back(visible_landmarks(scene_, loop.at(t_s).pose).size());
  }
  std::sort(counts.begin(), counts.end());
  EXPECT_GE(counts[counts.size() / 2], 5U);
  EXPECT_LE(counts[counts.size() / 2], 20U);
  EXPECT_GE(counts[counts.size() / 10], 1U);
  RecordProperty("median", static_cast<int>(counts[counts.size() / 2]));
  RecordProperty("tenth", static_cast<int>(counts[counts.size() / 10]));
}

INSTANTIATE_TEST_SUITE_P(All, Scenarios,
                         testing::Values("apartment", "corridor_loop", "crowd", "dark_room",
                                         "empty", "living_room", "stairs"),
                         [](const auto& one) { return one.param; });

TEST(Apartment, HasALoopOfFortyMetres) {
  const Scene scene = scene_named("apartment");
  EXPECT_GE(DrivePlan(scene.start, *find_path(scene, "loop1")).length_m(), 40.0);
}

TEST(DarkRoom, IsDark) { EXPECT_LE(scene_named("dark_room").lamp_level, 0.05); }

TEST(Stairs, GoDownAndUp) {
  const Scene scene = scene_named("stairs");
  EXPECT_EQ(scene.pits.size(), 1U);
  const auto drop = std::count_if(scene.meshes.begin(), scene.meshes.end(), [](const Mesh& mesh) {
    return mesh.surface_class == SurfaceClass::kDropOff;
  });
  EXPECT_EQ(drop, 2);
}

TEST(Crowd, Walks) { EXPECT_GE(scene_named("crowd").walkers.size(), 6U); }

}  // namespace
}  // namespace roomwise::simulator
