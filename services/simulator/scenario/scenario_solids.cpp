#include <algorithm>
#include <cmath>

#include "services/simulator/core/scene_furniture.h"
#include "services/simulator/scenario/scenario_parts.h"

namespace roomwise::simulator {
namespace {

const std::vector<std::string> kClassNames{"obstacle", "wall"};

/// Corners of the rectangle from least_m to largest_m.
struct Rectangle {
  Eigen::Vector2d least_m;
  Eigen::Vector2d largest_m;
};

Rectangle rectangle_of(TableReader& table) {
  const Rectangle rectangle{table.vector2("least_m", kPlace_m),
                            table.vector2("largest_m", kPlace_m)};
  const Eigen::Vector2d size_m = rectangle.largest_m - rectangle.least_m;
  if (!(size_m.minCoeff() >= kSize_m.least)) table.refuse("largest_m", "beyond least_m");
  return rectangle;
}

SurfaceClass class_of(TableReader& table, std::size_t fallback) {
  return table.choice("class", kClassNames, fallback) == 0 ? SurfaceClass::kObstacle
                                                           : SurfaceClass::kWall;
}

/// The steps that lead down into a pit from one of its sides, if it has any.
void read_pit_steps(TableReader& table, Scene& scene, const Rectangle& pit, double depth_m,
                    int material) {
  const int steps = table.whole("steps", 0, 50, 0);
  if (steps == 0) return;
  const double tread_m = table.number("tread_m", {0.05, 5.0});
  const double riser_m = table.number("riser_m", {0.02, 1.0});
  const auto side = table.choice("steps_from", {"west", "south", "east", "north"});
  const Eigen::Vector2d size_m = pit.largest_m - pit.least_m;
  const Eigen::Vector2d middle_m = (pit.largest_m + pit.least_m) / 2;
  const bool along_x = side % 2 == 0;
  if (steps * tread_m > size_m[along_x ? 0 : 1]) table.refuse("tread_m", "short enough to fit");
  if (steps * riser_m >= depth_m) table.refuse("riser_m", "low enough for the depth");
  const double heading_rad = static_cast<double>(side) * std::acos(0.0);
  const double half_m = size_m[along_x ? 0 : 1] / 2;
  const Pose2 T_world_steps{middle_m.x() - half_m * std::cos(heading_rad),
                            middle_m.y() - half_m * std::sin(heading_rad), heading_rad};
  add_to(
      scene,
      moved(steps_down(steps, tread_m, riser_m, size_m[along_x ? 1 : 0], depth_m), T_world_steps),
      material, SurfaceClass::kDropOff);
}

std::vector<Eigen::AlignedBox2d> read_pits(TableReader& file, Scene& scene) {
  std::vector<Eigen::AlignedBox2d> holes;
  for (TableReader& table : file.tables("pit", 20)) {
    const auto [least_m, largest_m] = rectangle_of(table);
    const double depth_m = table.number("depth_m", {0.05, 20.0});
    const int material = material_of(table, scene);
    read_pit_steps(table, scene, {least_m, largest_m}, depth_m, material);
    table.finish();
    add_to(scene, pit_lining(least_m, largest_m, depth_m), material, SurfaceClass::kDropOff);
    scene.pits.push_back(
        {{least_m, {largest_m.x(), least_m.y()}, largest_m, {least_m.x(), largest_m.y()}}});
    holes.emplace_back(least_m, largest_m);
  }
  return holes;
}

void read_boxes(TableReader& file, Scene& scene) {
  for (TableReader& table : file.tables("box", kMostOfAKind)) {
    const Eigen::Vector3d size_m = table.vector3("size_m", kSize_m);
    const Pose2 place = placement_of(table);
    const double low_m = table.number("low_m", kHeight_m, 0.0);
    const int material = material_of(table, scene);
    const SurfaceClass surface_class = class_of(table, 0);
    table.finish();
    const Eigen::Vector3d half_m(size_m.x() / 2, size_m.y() / 2, 0.0);
    add_to(scene, moved(box(-half_m, {half_m.x(), half_m.y(), size_m.z()}), place, low_m), material,
           surface_class);
  }
}

void read_cylinders(TableReader& file, Scene& scene) {
  for (TableReader& table : file.tables("cylinder", kMostOfAKind)) {
    const double radius_m = table.number("radius_m", {0.005, 20.0});
    const double height_m = table.number("height_m", kSize_m);
    const Pose2 place = placement_of(table);
    const double low_m = table.number("low_m", kHeight_m, 0.0);
    const int material = material_of(table, scene);
    table.finish();
    const int sides = std::clamp(static_cast<int>(160.0 * radius_m), 16, 96);
    add_to(scene, moved(cylinder(radius_m, 0.0, height_m, sides), place, low_m), material,
           SurfaceClass::kObstacle);
  }
}

/// A plate so thin that its edges are no landmarks: a mirror, a picture, a window pane.
void read_panels(TableReader& file, Scene& scene) {
  constexpr double kThickness_m = 0.01;
  for (TableReader& table : file.tables("panel", kMostOfAKind)) {
    const Eigen::Vector2d size_m = table.vector2("size_m", kSize_m);
    const Pose2 place = placement_of(table);
    const double low_m = table.number("low_m", kHeight_m, 0.0);
    const int material = material_of(table, scene);
    const SurfaceClass surface_class = class_of(table, 1);
    table.finish();
    Solid panel = box({0.0, -size_m.x() / 2, 0.0}, {kThickness_m, size_m.x() / 2, size_m.y()});
    for (Block& block : panel.blocks) block.has_landmarks = false;
    add_to(scene, moved(panel, place, low_m), material, surface_class);
  }
}

std::vector<std::array<std::uint32_t, 3>> triangles_of(TableReader& table, std::size_t corners) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const Limits indices{0.0, static_cast<double>(corners - 1)};
  for (const Eigen::Vector3d& row : table.points3("triangles", indices, 1, 20000)) {
    if ((row.array() != row.array().floor()).any()) {
      table.refuse("triangles", "whole numbers: indices into corners_m");
    }
    triangles.push_back({static_cast<std::uint32_t>(row[0]), static_cast<std::uint32_t>(row[1]),
                         static_cast<std::uint32_t>(row[2])});
  }
  return triangles;
}

void read_meshes(TableReader& file, Scene& scene) {
  for (TableReader& table : file.tables("mesh", 100)) {
    const auto corners_m = table.points3("corners_m", kPlace_m, 3, 10000);
    const auto triangles = triangles_of(table, corners_m.size());
    const Pose2 place = placement_of(table);
    const double low_m = table.number("low_m", kHeight_m, 0.0);
    const int material = material_of(table, scene);
    const SurfaceClass surface_class = class_of(table, 0);
    table.finish();
    add_to(scene, moved(triangle_mesh(corners_m, triangles), place, low_m), material,
           surface_class);
  }
}

}  // namespace

void read_grounds(TableReader& file, Scene& scene) {
  const auto holes = read_pits(file, scene);
  for (TableReader& table : file.tables("floor", kMostOfAKind)) {
    const auto [least_m, largest_m] = rectangle_of(table);
    const double height_m = table.number("height_m", {0.0, 0.02}, 0.0);
    const int material = material_of(table, scene);
    table.finish();
    add_to(scene, level_rectangle(least_m, largest_m, height_m, true, holes), material,
           SurfaceClass::kFloor);
  }
  for (TableReader& table : file.tables("ceiling", kMostOfAKind)) {
    const auto [least_m, largest_m] = rectangle_of(table);
    const double height_m = table.number("height_m", kHeight_m);
    const int material = material_of(table, scene);
    table.finish();
    add_to(scene, level_rectangle(least_m, largest_m, height_m, false), material,
           SurfaceClass::kObstacle);
  }
}

void read_solids(TableReader& file, Scene& scene) {
  read_boxes(file, scene);
  read_cylinders(file, scene);
  read_panels(file, scene);
  read_meshes(file, scene);
}

}  // namespace roomwise::simulator
