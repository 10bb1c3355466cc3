// The reader is strict: what it does not know it refuses, naming file, line and key.
#include "services/simulator/scenario/scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "tests/support/build_paths.h"

namespace roomwise::simulator {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// Seven lines that every text below begins with.
const std::string kBasis = R"([robot]
at_m = [1.0, 2.0]
heading_rad = 0.5

[[material]]
name = "grey"
color = [0.5, 0.5, 0.5]
)";

std::string error_of(const std::string& text) {
  try {
    read_scenario(text, "room.toml");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Scenario, ReadsARoom) {
  const Scenario scenario = read_scenario(kBasis + R"(
[camera]
z_m = 0.35
pitch_down_rad = 0.1
[light]
ambient = 0.2
lamp_level = 0.5
[[lamp]]
at_m = [0.0, 0.0, 2.0]
power = [1.0, 2.0, 3.0]
[[floor]]
least_m = [-3.0, -3.0]
largest_m = [3.0, 3.0]
material = "grey"
[[wall]]
points_m = [[-3.0, -3.0], [3.0, -3.0], [3.0, 3.0]]
material = "grey"
[[wall.opening]]
leg = 1
from_m = 1.0
to_m = 2.0
head_m = 2.0
[[walker]]
name = "anna"
way_m = [[-2.0, 0.0], [-2.0, 2.0]]
speed_mps = 1.0
legs = "grey"
body = "grey"
head = "grey"
[[path]]
name = "loop1"
corners_m = [[2.0, 2.0], [2.0, 0.0]]
[[path]]
name = "loop2"
same_as = "loop1"
rounds = 2
[[fault]]
name = "wheel_slip"
at_s = 3.0
value = 0.5
)",
                                          "room.toml");
  const Scene& scene = scenario.scene;
  EXPECT_DOUBLE_EQ(scene.start.heading_rad, 0.5);
  EXPECT_DOUBLE_EQ(scene.camera.z_m, 0.35);
  EXPECT_DOUBLE_EQ(scene.lamp_level, 0.5);
  EXPECT_FLOAT_EQ(scene.lamps.at(0).power[2], 3.0F);
  EXPECT_EQ(scene.meshes.size(), 3U);  // floor and two legs of the wall
  EXPECT_EQ(scene.blocks.size(), 4U);  // the second leg in three pieces
  EXPECT_EQ(scene.walkers.at(0).meshes.size(), 3U);
  EXPECT_EQ(scene.paths.at(1).rounds, 2);
  EXPECT_FALSE(scene.landmarks.empty());
  EXPECT_EQ(scenario.faults.at(0).name, "wheel_slip");
  EXPECT_THAT(scenario.faults.at(0).where, StartsWith("room.toml:"));
}

TEST(Scenario, SameTextGivesTheSameScene) {
  const std::string text =
      kBasis + "[[box]]\nat_m = [0.0, 0.0]\nsize_m = [1.0, 0.5, 0.7]\nmaterial = \"grey\"\n";
  const Scene one = read_scenario(text, "a").scene;
  const Scene other = read_scenario(text, "b").scene;
  ASSERT_EQ(one.meshes.size(), other.meshes.size());
  EXPECT_EQ(one.meshes[0].corners_m, other.meshes[0].corners_m);
  ASSERT_EQ(one.landmarks.size(), other.landmarks.size());
  EXPECT_EQ(one.landmarks[3].position_m, other.landmarks[3].position_m);
}

struct Refusal {
  std::string name;
  std::string text;  ///< after the seven lines of kBasis
  std::string error;
};

class Refused : public testing::TestWithParam<Refusal> {};

TEST_P(Refused, NamesFileLineAndKey) {
  EXPECT_THAT(error_of(kBasis + GetParam().text), StartsWith(GetParam().error));
}

INSTANTIATE_TEST_SUITE_P(
    Scenario, Refused,
    testing::Values(
        Refusal{"UnknownTable", "[[bax]]\nat_m = [0, 0]\n", "room.toml:8: bax must be one of box"},
        Refusal{"UnknownKey", "[[chair]]\nat_m = [0, 0]\nmaterial = \"grey\"\ncolour = 3\n",
                "room.toml:11: chair.colour must be one of at_m, heading_rad, material, size_m"},
        Refusal{"UnknownMaterial", "[[chair]]\nat_m = [0, 0]\nmaterial = \"gold\"\n",
                "room.toml:10: chair.material must be one of \"grey\""},
        Refusal{"MissingKey", "[[chair]]\nmaterial = \"grey\"\n",
                "room.toml:8: chair.at_m must be given: 2 numbers in [-200, 200]"},
        Refusal{"WrongType", "[light]\nambient = \"bright\"\n",
                "room.toml:9: light.ambient must be a number in [0, 10]"},
        Refusal{"OutOfRange", "[light]\nambient = 11.0\n",
                "room.toml:9: light.ambient must be a number in [0, 10]"},
        Refusal{"NotFinite", "[light]\nambient = nan\n", "room.toml:9: light.ambient must be"},
        Refusal{"Infinite", "[camera]\nz_m = inf\n", "room.toml:9: camera.z_m must be"},
        Refusal{"HugeWholeNumber", "[light]\nambient = 9223372036854775807\n",
                "room.toml:9: light.ambient must be"},
        Refusal{"PointOfThree", "[[chair]]\nat_m = [0, 0, 0]\nmaterial = \"grey\"\n",
                "room.toml:9: chair.at_m must be 2 numbers"},
        Refusal{"TableForArray", "[chair]\nat_m = [0, 0]\n",
                "room.toml:8: chair must be at most 500 tables [[chair]]"},
        Refusal{"MaterialTwice", "[[material]]\nname = \"grey\"\n",
                "room.toml:9: material.name must be a name no other material has"},
        Refusal{"OpeningBeyondTheWall",
                "[[wall]]\npoints_m = [[0, 0], [2, 0]]\nmaterial = \"grey\"\n"
                "[[wall.opening]]\nfrom_m = 1.0\nto_m = 2.5\nhead_m = 2.0\n",
                "room.toml:13: opening.to_m must be a number in [1, 2]"},
        Refusal{"OpeningsOverlap",
                "[[wall]]\npoints_m = [[0, 0], [2, 0]]\nmaterial = \"grey\"\n"
                "[[wall.opening]]\nfrom_m = 0.5\nto_m = 1.5\nhead_m = 2.0\n"
                "[[wall.opening]]\nfrom_m = 1.0\nto_m = 1.7\nhead_m = 2.0\n",
                "room.toml:11: wall.opening must be apart from the others"},
        Refusal{"RectangleInsideOut",
                "[[floor]]\nleast_m = [1, 1]\nlargest_m = [0, 2]\nmaterial = \"grey\"\n",
                "room.toml:10: floor.largest_m must be beyond least_m"},
        Refusal{"StepsTooLongForThePit",
                "[[pit]]\nleast_m = [0, 0]\nlargest_m = [1, 2]\ndepth_m = 2.0\n"
                "material = \"grey\"\nsteps = 5\ntread_m = 0.3\nriser_m = 0.1\n"
                "steps_from = \"west\"\n",
                "room.toml:14: pit.tread_m must be short enough to fit"},
        Refusal{"TriangleOfNoCorner",
                "[[mesh]]\ncorners_m = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n"
                "triangles = [[0, 1, 3]]\nat_m = [0, 0]\nmaterial = \"grey\"\n",
                "room.toml:10: mesh.triangles must be"},
        Refusal{"TriangleOfHalfACorner",
                "[[mesh]]\ncorners_m = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n"
                "triangles = [[0, 1, 1.5]]\nat_m = [0, 0]\nmaterial = \"grey\"\n",
                "room.toml:10: mesh.triangles must be whole numbers"},
        Refusal{"WalkerOnTheSpot",
                "[[walker]]\nname = \"a\"\nway_m = [[0, 0], [0, 0]]\nspeed_mps = 1\n",
                "room.toml:10: walker.way_m must be corners at least 0.01 m apart"},
        Refusal{"PathOverTheStart", "[[path]]\nname = \"loop1\"\ncorners_m = [[3, 2], [1, 2]]\n",
                "room.toml:10: path.corners_m must be at least 0.05 m apart"},
        Refusal{"PathAsOneUnknown", "[[path]]\nname = \"loop2\"\nsame_as = \"loop1\"\n",
                "room.toml:10: path.same_as must be one of"},
        Refusal{"PathTwice",
                "[[path]]\nname = \"a\"\ncorners_m = [[3, 2]]\n"
                "[[path]]\nname = \"a\"\ncorners_m = [[3, 2]]\n",
                "room.toml:12: path.name must be a name no other path has"},
        Refusal{"NameWithSpaces", "[[fault]]\nname = \"a b\"\nat_s = 1\n",
                "room.toml:9: fault.name must be a name of letters"},
        Refusal{"NotToml", "[[box\n", "room.toml:8: text must be TOML"}),
    [](const auto& one) { return one.param.name; });

TEST(Scenario, NeedsARobot) {
  EXPECT_THAT(error_of("[light]\nambient = 0.3\n"), HasSubstr("robot must be given"));
}

TEST(Scenario, NamesTheFileThatCannotBeRead) {
  try {
    load_scenario("/nowhere/room.toml");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "/nowhere/room.toml: cannot read the scenario");
  }
}

TEST(FindScenario, TakesANameOrAFile) {
  const std::filesystem::path folder = source_folder() / "services/simulator/scenarios";
  EXPECT_EQ(find_scenario("empty", folder), folder / "empty.toml");
  EXPECT_EQ(find_scenario((folder / "empty.toml").string(), "/elsewhere"), folder / "empty.toml");
  try {
    find_scenario("ballroom", folder);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), StartsWith("ballroom: no such scenario"));
    EXPECT_THAT(error.what(), HasSubstr("crowd, dark_room, empty, living_room, stairs"));
  }
}

}  // namespace
}  // namespace roomwise::simulator
