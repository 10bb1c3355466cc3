#include "services/simulator/scenario/scenario.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "services/simulator/core/truth.h"
#include "services/simulator/scenario/scenario_parts.h"

namespace roomwise::simulator {
namespace {

void read_light(TableReader& file, Scene& scene) {
  if (auto light = file.table("light")) {
    scene.ambient = light->number("ambient", {0.0, 10.0}, scene.ambient);
    scene.lamp_level = light->number("lamp_level", {0.0, 10.0}, scene.lamp_level);
    light->finish();
  }
  for (TableReader& table : file.tables("lamp", 16)) {
    Lamp lamp;
    lamp.position_m = table.vector3("at_m", kPlace_m).cast<float>();
    const Eigen::Vector3d power = table.vector3("power", {0.0, 1000.0});
    lamp.power = {static_cast<float>(power[0]), static_cast<float>(power[1]),
                  static_cast<float>(power[2])};
    table.finish();
    scene.lamps.push_back(lamp);
  }
}

void read_robot(TableReader& file, Scene& scene) {
  auto robot = file.table("robot");
  if (!robot) file.refuse("robot", "given: a table with at_m and heading_rad");
  scene.start = placement_of(*robot);
  robot->finish();
}

void read_camera(TableReader& file, Scene& scene) {
  auto table = file.table("camera");
  if (!table) return;
  CameraMount& mount = scene.camera;
  mount.x_m = table->number("x_m", {-0.5, 0.5}, mount.x_m);
  mount.y_m = table->number("y_m", {-0.5, 0.5}, mount.y_m);
  mount.z_m = table->number("z_m", {0.0, 3.0}, mount.z_m);
  mount.yaw_rad = table->number("yaw_rad", kAngle_rad, mount.yaw_rad);
  mount.pitch_down_rad = table->number("pitch_down_rad", {-1.6, 1.6}, mount.pitch_down_rad);
  table->finish();
}

std::vector<TimedFault> read_faults(TableReader& file) {
  std::vector<TimedFault> faults;
  for (TableReader& table : file.tables("fault", 100)) {
    TimedFault fault;
    fault.name = table.name("name");
    fault.at_s = table.number("at_s", {0.0, 1e6});
    fault.for_s = table.number("for_s", {0.0, 1e6}, 0.0);
    fault.value = table.number("value", {-1e6, 1e6}, 0.0);
    fault.where = table.where();
    table.finish();
    faults.push_back(std::move(fault));
  }
  return faults;
}

Scenario scenario_of(TableReader& file) {
  Scenario scenario;
  read_materials(file, scenario.scene);
  read_grounds(file, scenario.scene);
  read_walls(file, scenario.scene);
  read_solids(file, scenario.scene);
  read_furniture(file, scenario.scene);
  read_walkers(file, scenario.scene);
  read_light(file, scenario.scene);
  read_robot(file, scenario.scene);
  read_camera(file, scenario.scene);
  read_paths(file, scenario.scene);
  scenario.faults = read_faults(file);
  file.finish();
  return scenario;
}

/// A world of more parts would keep true_landmarks busy for minutes.
void check_size(const Scene& scene, std::string_view source) {
  constexpr std::size_t kMostParts = 3000;
  const auto parts = static_cast<std::size_t>(
      std::count_if(scene.blocks.begin(), scene.blocks.end(),
                    [](const Block& block) { return block.has_landmarks; }));
  if (parts + scene.columns.size() > kMostParts) {
    throw std::runtime_error(
        fmt::format("{}:1: solid parts must be at most {} in all", source, kMostParts));
  }
}

std::string names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

Scenario read_scenario(std::string_view toml, std::string_view source) {
  try {
    const toml::table table = toml::parse(toml, source);
    TableReader file(table, source, "");
    Scenario scenario = scenario_of(file);
    check_size(scenario.scene, source);
    scenario.scene.landmarks = true_landmarks(scenario.scene);
    return scenario;
  } catch (const toml::parse_error& error) {
    throw std::runtime_error(fmt::format("{}:{}: text must be TOML: {}", source,
                                         error.source().begin.line, error.description()));
  }
}

Scenario load_scenario(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) {
    throw std::runtime_error(fmt::format("{}: cannot read the scenario", path.string()));
  }
  Scenario scenario = read_scenario(text.str(), path.string());
  scenario.scene.name = path.stem().string();
  return scenario;
}

std::filesystem::path find_scenario(const std::string& name_or_path,
                                    const std::filesystem::path& folder) {
  const std::filesystem::path path = name_or_path.ends_with(".toml")
                                         ? std::filesystem::path(name_or_path)
                                         : folder / (name_or_path + ".toml");
  if (std::filesystem::is_regular_file(path)) return path;
  throw std::runtime_error(fmt::format("{}: no such scenario; {} has {}", name_or_path,
                                       folder.string(), names_in(folder)));
}

}  // namespace roomwise::simulator
