#include <algorithm>
#include <numbers>

#include "services/simulator/core/scene_furniture.h"
#include "services/simulator/scenario/scenario_parts.h"

namespace roomwise::simulator {
namespace {

constexpr Limits kPiece_m{0.1, 10.0};

/// A wall along a line of points, as one table gives it.
struct WallLine {
  std::vector<Eigen::Vector2d> points_m;
  bool closed = false;
  double thickness_m = 0.1;
  double height_m = 2.5;

  std::size_t legs() const { return closed ? points_m.size() : points_m.size() - 1; }
  Eigen::Vector2d leg_m(std::size_t leg) const {
    return points_m[(leg + 1) % points_m.size()] - points_m[leg];
  }
  /// How far a leg is built beyond its ends, so that legs meet in a full corner.
  double before_m(std::size_t leg) const { return closed || leg > 0 ? thickness_m / 2 : 0.0; }
  double after_m(std::size_t leg) const {
    return closed || leg + 1 < legs() ? thickness_m / 2 : 0.0;
  }
};

WallLine wall_line_of(TableReader& table) {
  WallLine line;
  line.points_m = table.points2("points_m", kPlace_m, 2, 100);
  line.closed = table.flag("closed", false);
  line.thickness_m = table.number("thickness_m", {0.02, 2.0}, line.thickness_m);
  line.height_m = table.number("height_m", {0.05, 20.0}, line.height_m);
  for (std::size_t leg = 0; leg < line.legs(); ++leg) {
    if (line.leg_m(leg).norm() < kSize_m.least) table.refuse("points_m", "apart");
  }
  return line;
}

void check_openings(TableReader& table, std::vector<Opening> openings) {
  std::sort(openings.begin(), openings.end(),
            [](const Opening& a, const Opening& b) { return a.from_m < b.from_m; });
  for (std::size_t i = 1; i < openings.size(); ++i) {
    if (openings[i].from_m < openings[i - 1].to_m) table.refuse("opening", "apart from the others");
  }
}

/// Openings of each leg of a wall.
std::vector<std::vector<Opening>> openings_of(TableReader& table, const WallLine& line) {
  std::vector<std::vector<Opening>> openings(line.legs());
  for (TableReader& entry : table.tables("opening", 50)) {
    const auto leg =
        static_cast<std::size_t>(entry.whole("leg", 0, static_cast<int>(line.legs()) - 1, 0));
    Opening opening;
    opening.from_m = entry.number("from_m", {0.0, line.leg_m(leg).norm()});
    opening.to_m = entry.number("to_m", {opening.from_m, line.leg_m(leg).norm()});
    opening.sill_m = entry.number("sill_m", {0.0, line.height_m}, 0.0);
    opening.head_m = entry.number("head_m", {opening.sill_m, line.height_m});
    entry.finish();
    openings[leg].push_back(opening);
  }
  for (const auto& of_leg : openings) check_openings(table, of_leg);
  return openings;
}

Solid wall_leg(const WallLine& line, std::size_t leg, std::vector<Opening> openings) {
  const Eigen::Vector2d along = line.leg_m(leg);
  const double before_m = line.before_m(leg);
  for (Opening& opening : openings) {
    opening.from_m += before_m;
    opening.to_m += before_m;
  }
  const Eigen::Vector2d from_m = line.points_m[leg] - along.normalized() * before_m;
  return moved(
      wall(along.norm() + before_m + line.after_m(leg), line.thickness_m, line.height_m, openings),
      {from_m.x(), from_m.y(), std::atan2(along.y(), along.x())});
}

void read_tables(TableReader& file, Scene& scene) {
  for (TableReader& table : file.tables("table", kMostOfAKind)) {
    const Eigen::Vector3d size_m = table.vector3("size_m", kPiece_m);
    const double top_m = table.number("top_m", {0.01, size_m.z() / 2}, 0.04);
    const double leg_m = table.number("leg_m", {0.02, 0.2}, 0.06);
    const Pose2 place = placement_of(table);
    const int material = material_of(table, scene);
    table.finish();
    if (leg_m * 2 + 0.04 > size_m.head<2>().minCoeff()) {
      table.refuse("leg_m", "less than half of the table");
    }
    add_to(scene, moved(roomwise::simulator::table(size_m, top_m, leg_m), place), material,
           SurfaceClass::kObstacle);
  }
}

void read_chairs(TableReader& file, Scene& scene) {
  for (TableReader& table : file.tables("chair", kMostOfAKind)) {
    const Eigen::Vector3d size_m =
        table.vector3("size_m", kPiece_m, Eigen::Vector3d(0.42, 0.42, 0.9));
    const Pose2 place = placement_of(table);
    const int material = material_of(table, scene);
    table.finish();
    add_to(scene, moved(chair(size_m, 0.04), place), material, SurfaceClass::kObstacle);
  }
}

void read_sofas(TableReader& file, Scene& scene) {
  for (TableReader& table : file.tables("sofa", kMostOfAKind)) {
    const Eigen::Vector3d size_m =
        table.vector3("size_m", kPiece_m, Eigen::Vector3d(0.9, 2.0, 0.85));
    const Pose2 place = placement_of(table);
    const int material = material_of(table, scene);
    table.finish();
    add_to(scene, moved(sofa(size_m), place), material, SurfaceClass::kObstacle);
  }
}

void read_shelves(TableReader& file, Scene& scene) {
  for (TableReader& table : file.tables("shelf", kMostOfAKind)) {
    const Eigen::Vector3d size_m =
        table.vector3("size_m", kPiece_m, Eigen::Vector3d(0.3, 0.8, 1.8));
    const int boards = table.whole("boards", 2, 20, 5);
    const Pose2 place = placement_of(table);
    const int material = material_of(table, scene);
    table.finish();
    add_to(scene, moved(shelf(size_m, boards), place), material, SurfaceClass::kObstacle);
  }
}

void read_stairs(TableReader& file, Scene& scene) {
  for (TableReader& table : file.tables("stairs", 100)) {
    const int steps = table.whole("steps", 1, 50);
    const double tread_m = table.number("tread_m", {0.05, 5.0}, 0.28);
    const double riser_m = table.number("riser_m", {0.02, 1.0}, 0.17);
    const double width_m = table.number("width_m", {0.1, 50.0});
    const Pose2 place = placement_of(table);
    const int material = material_of(table, scene);
    table.finish();
    add_to(scene, moved(steps_up(steps, tread_m, riser_m, width_m), place), material,
           SurfaceClass::kObstacle);
  }
}

}  // namespace

void read_walls(TableReader& file, Scene& scene) {
  for (TableReader& table : file.tables("wall", kMostOfAKind)) {
    const WallLine line = wall_line_of(table);
    const auto openings = openings_of(table, line);
    const int material = material_of(table, scene);
    table.finish();
    for (std::size_t leg = 0; leg < line.legs(); ++leg) {
      add_to(scene, wall_leg(line, leg, openings[leg]), material, SurfaceClass::kWall);
    }
  }
}

void read_furniture(TableReader& file, Scene& scene) {
  read_tables(file, scene);
  read_chairs(file, scene);
  read_sofas(file, scene);
  read_shelves(file, scene);
  read_stairs(file, scene);
}

}  // namespace roomwise::simulator
