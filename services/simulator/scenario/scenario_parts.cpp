#include "services/simulator/scenario/scenario_parts.h"

#include <algorithm>
#include <utility>

#include "services/simulator/core/scene_furniture.h"

namespace roomwise::simulator {
namespace {

const std::vector<std::string> kPatternNames{"plain", "checker", "stripes", "wood", "noise"};

std::array<float, 3> color_of(TableReader& table, std::string_view key,
                              const std::array<float, 3>& fallback) {
  const Eigen::Vector3d color =
      table.vector3(key, {0.0, 1.0},
                    Eigen::Vector3d(double{fallback[0]}, double{fallback[1]}, double{fallback[2]}));
  return {static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2])};
}

float share_of(TableReader& table, std::string_view key, float fallback) {
  return static_cast<float>(table.number(key, {0.0, 1.0}, double{fallback}));
}

Material material_from(TableReader& table) {
  Material material;
  material.name = table.name("name");
  material.pattern = static_cast<Pattern>(table.choice("pattern", kPatternNames, 0));
  material.color = color_of(table, "color", material.color);
  material.second_color = color_of(table, "second_color", material.second_color);
  material.pattern_size_m = static_cast<float>(
      table.number("pattern_size_m", {0.001, 100.0}, double{material.pattern_size_m}));
  material.infrared_reflectance =
      share_of(table, "infrared_reflectance", material.infrared_reflectance);
  material.mirror = share_of(table, "mirror", material.mirror);
  material.see_through = table.flag("see_through", false);
  table.finish();
  return material;
}

std::vector<std::string> material_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Material& material : scene.materials) names.push_back(material.name);
  return names;
}

void add_part(Walker& walker, Solid part, int material) {
  part.mesh.material = material;
  walker.meshes.push_back(std::move(part.mesh));
}

void check_way(TableReader& table, const std::vector<Eigen::Vector2d>& way_m) {
  for (std::size_t i = 0; i < way_m.size(); ++i) {
    if ((way_m[(i + 1) % way_m.size()] - way_m[i]).norm() < 0.01) {
      table.refuse("way_m", "corners at least 0.01 m apart");
    }
  }
}

const Path& path_named(TableReader& table, const Scene& scene) {
  std::vector<std::string> names;
  for (const Path& path : scene.paths) names.push_back(path.name);
  return scene.paths[table.choice("same_as", names)];
}

void check_corners(TableReader& table, const Scene& scene,
                   const std::vector<Eigen::Vector2d>& corners_m) {
  Eigen::Vector2d before_m = scene.start.position_m();
  for (std::size_t i = 0; i <= corners_m.size(); ++i) {
    const Eigen::Vector2d next_m = i < corners_m.size() ? corners_m[i] : scene.start.position_m();
    if ((next_m - before_m).norm() < 0.05) {
      table.refuse("corners_m", "at least 0.05 m apart, the robot's start among them");
    }
    before_m = next_m;
  }
}

}  // namespace

int material_of(TableReader& table, const Scene& scene, std::string_view key) {
  return static_cast<int>(table.choice(key, material_names(scene)));
}

Pose2 placement_of(TableReader& table) {
  const Eigen::Vector2d at_m = table.vector2("at_m", kPlace_m);
  return {at_m.x(), at_m.y(), wrap_angle(table.number("heading_rad", kAngle_rad, 0.0))};
}

void read_materials(TableReader& file, Scene& scene) {
  for (TableReader& table : file.tables("material", 200)) {
    Material material = material_from(table);
    const auto names = material_names(scene);
    if (std::find(names.begin(), names.end(), material.name) != names.end()) {
      table.refuse("name", "a name no other material has");
    }
    scene.materials.push_back(std::move(material));
  }
}

void read_walkers(TableReader& file, Scene& scene) {
  for (TableReader& table : file.tables("walker", 50)) {
    Walker walker;
    walker.name = table.name("name");
    walker.way_m = table.points2("way_m", kPlace_m, 2, 100);
    check_way(table, walker.way_m);
    walker.speed_mps = table.number("speed_mps", {0.0, 5.0});
    walker.start_m = table.number("start_m", {0.0, 1000.0}, 0.0);
    walker.radius_m = table.number("radius_m", {0.05, 2.0}, walker.radius_m);
    const PersonParts parts = person(table.number("height_m", {0.5, 2.5}, 1.75));
    add_part(walker, parts.legs, material_of(table, scene, "legs"));
    add_part(walker, parts.body, material_of(table, scene, "body"));
    add_part(walker, parts.head, material_of(table, scene, "head"));
    table.finish();
    scene.walkers.push_back(std::move(walker));
  }
}

void read_paths(TableReader& file, Scene& scene) {
  for (TableReader& table : file.tables("path", 20)) {
    Path path;
    path.name = table.name("name");
    if (find_path(scene, path.name) != nullptr) table.refuse("name", "a name no other path has");
    path.corners_m = table.has("same_as") ? path_named(table, scene).corners_m
                                          : table.points2("corners_m", kPlace_m, 1, 1000);
    check_corners(table, scene, path.corners_m);
    path.rounds = table.whole("rounds", 1, 1000, 1);
    table.finish();
    scene.paths.push_back(std::move(path));
  }
}

}  // namespace roomwise::simulator
