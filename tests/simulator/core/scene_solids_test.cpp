// Laws of solids: closed, facing outward, of the volume the formula gives.
#include "services/simulator/core/scene_solids.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "services/simulator/core/scene_furniture.h"

namespace roomwise::simulator {
namespace {

using Place = std::array<float, 3>;

Place place_of(const Eigen::Vector3f& p) { return {p.x(), p.y(), p.z()}; }

/// Every directed edge is met as often one way as the other: no ray gets in or out between faces.
bool is_watertight(const Mesh& mesh) {
  std::map<std::pair<Place, Place>, int> balance;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Place a = place_of(mesh.corners_m[triangle[i]]);
      const Place b = place_of(mesh.corners_m[triangle[(i + 1) % 3]]);
      ++balance[{a, b}];
      --balance[{b, a}];
    }
  }
  return std::all_of(balance.begin(), balance.end(),
                     [](const auto& edge) { return edge.second == 0; });
}

/// Positive if the faces look outward (divergence theorem).
double volume_m3(const Mesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d p = mesh.corners_m[a].cast<double>();
    const Eigen::Vector3d q = mesh.corners_m[b].cast<double>();
    const Eigen::Vector3d r = mesh.corners_m[c].cast<double>();
    sum += p.dot(q.cross(r)) / 6.0;
  }
  return sum;
}

double area_m2(const Mesh& mesh, bool of_texture) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    if (of_texture) {
      const Eigen::Vector2f u = mesh.texture_m[b] - mesh.texture_m[a];
      const Eigen::Vector2f v = mesh.texture_m[c] - mesh.texture_m[a];
      sum += std::abs(double{u.x()} * double{v.y()} - double{u.y()} * double{v.x()}) / 2.0;
    } else {
      const Eigen::Vector3f u = mesh.corners_m[b] - mesh.corners_m[a];
      const Eigen::Vector3f v = mesh.corners_m[c] - mesh.corners_m[a];
      sum += double{u.cross(v).norm()} / 2.0;
    }
  }
  return sum;
}

double metres(int least_cm, int most_cm) { return 0.01 * *rc::gen::inRange(least_cm, most_cm); }

Pose2 any_pose() { return {metres(-500, 500), metres(-500, 500), metres(-314, 314)}; }

/// What must hold of every closed solid, wherever it is put.
void check_closed(const Solid& solid, double wanted_m3) {
  const Solid there = moved(solid, any_pose(), metres(0, 100));
  for (const Mesh* mesh : {&solid.mesh, &there.mesh}) {
    RC_ASSERT(mesh->corners_m.size() == mesh->texture_m.size());
    RC_ASSERT(is_watertight(*mesh));
    RC_ASSERT(std::abs(volume_m3(*mesh) - wanted_m3) < 2e-3 * wanted_m3 + 1e-4);
  }
  RC_ASSERT(std::abs(area_m2(solid.mesh, true) - area_m2(solid.mesh, false)) <
            1e-3 * area_m2(solid.mesh, false));
}

RC_GTEST_PROP(Solids, BoxIsClosed, ()) {
  const Eigen::Vector3d low_m(metres(-300, 300), metres(-300, 300), metres(0, 200));
  const Eigen::Vector3d size_m(metres(1, 300), metres(1, 300), metres(1, 300));
  check_closed(box(low_m, low_m + size_m), size_m.prod());
}

RC_GTEST_PROP(Solids, CylinderIsClosed, ()) {
  const double radius_m = metres(1, 100);
  const double height_m = metres(1, 300);
  const int sides = *rc::gen::inRange(3, 60);
  const double slice_rad = 2.0 * std::numbers::pi / sides;
  check_closed(cylinder(radius_m, 0.0, height_m, sides),
               sides * std::sin(slice_rad) / 2.0 * radius_m * radius_m * height_m);
}

RC_GTEST_PROP(Solids, StepsUpAreClosed, ()) {
  const int steps = *rc::gen::inRange(1, 12);
  const double tread_m = metres(10, 50);
  const double riser_m = metres(5, 30);
  const double width_m = metres(30, 300);
  check_closed(steps_up(steps, tread_m, riser_m, width_m),
               tread_m * riser_m * width_m * steps * (steps + 1) / 2.0);
}

RC_GTEST_PROP(Solids, StepsDownAreClosed, ()) {
  const int steps = *rc::gen::inRange(1, 10);
  const double tread_m = metres(10, 50);
  const double riser_m = metres(5, 20);
  const double depth_m = steps * riser_m + 0.3;
  check_closed(steps_down(steps, tread_m, riser_m, 1.2, depth_m),
               tread_m * 1.2 * (steps * depth_m - riser_m * steps * (steps + 1) / 2.0));
}

RC_GTEST_PROP(Solids, WallIsClosedAroundItsOpenings, ()) {
  const double length_m = metres(300, 900);
  const double thickness_m = metres(5, 40);
  const Opening door{0.0, metres(50, 100), 0.0, 2.0};
  const Opening window{door.to_m + metres(0, 50), 2.0 + metres(0, 100), 0.8, metres(100, 250)};
  check_closed(wall(length_m, thickness_m, 2.5, {window, door}),
               thickness_m * (length_m * 2.5 - door.to_m * 2.0 -
                              (window.to_m - window.from_m) * (window.head_m - 0.8)));
}

RC_GTEST_PROP(Solids, FurnitureIsClosed, ()) {
  const Eigen::Vector3d size_m(metres(50, 200), metres(50, 200), metres(40, 120));
  check_closed(table(size_m, 0.04, 0.06),
               size_m.x() * size_m.y() * 0.04 + 4 * 0.06 * 0.06 * (size_m.z() - 0.04));
  const PersonParts parts = person(metres(100, 200));
  for (const Solid& solid :
       {chair(size_m, 0.04), sofa(size_m), shelf(size_m, 4), parts.legs, parts.body, parts.head}) {
    const double volume = volume_m3(solid.mesh);
    RC_ASSERT(volume > 0.0);
    RC_ASSERT(volume < 1.2 * size_m.prod() + 0.3);
    check_closed(solid, volume);
  }
}

RC_GTEST_PROP(Solids, PlansMoveWithTheirMeshes, ()) {
  const double radius_m = metres(5, 50);
  Solid solid = box({-0.5, -0.3, 0.1}, {0.5, 0.3, 0.9});
  append(solid, cylinder(radius_m, 0.0, 0.4));
  const Pose2 pose = any_pose();
  const Solid there = moved(solid, pose, 0.2);
  RC_ASSERT((there.columns[0].center_m - pose.position_m()).norm() < 1e-12);
  RC_ASSERT(std::abs(there.columns[0].high_m - 0.6) < 1e-12);
  RC_ASSERT(std::abs(there.blocks[0].low_m - 0.3) < 1e-12);
  for (std::size_t i = 0; i < 4; ++i) {
    RC_ASSERT(
        (there.blocks[0].corners_m[i] - transform(pose, solid.blocks[0].corners_m[i])).norm() <
        1e-12);
  }
}

TEST(LevelRectangle, FacesUpWithHolesCutOut) {
  const std::vector<Eigen::AlignedBox2d> holes{
      {Eigen::Vector2d(1.0, 1.0), Eigen::Vector2d(2.0, 2.5)},
      {Eigen::Vector2d(3.5, -1.0), Eigen::Vector2d(9.0, 0.5)}};
  const Mesh floor = level_rectangle({0.0, 0.0}, {4.0, 3.0}, 0.0, true, holes).mesh;
  EXPECT_NEAR(area_m2(floor, false), 12.0 - 1.5 - 0.25, 1e-5);
  for (const auto& [a, b, c] : floor.triangles) {
    const Eigen::Vector3f normal =
        (floor.corners_m[b] - floor.corners_m[a]).cross(floor.corners_m[c] - floor.corners_m[a]);
    EXPECT_GT(normal.z(), 0.0F);
  }
}

TEST(PitLining, LooksInwardAndClosesUnderALid) {
  Solid pit = pit_lining({1.0, 2.0}, {3.0, 5.0}, 1.5);
  EXPECT_FALSE(is_watertight(pit.mesh));
  append(pit, level_rectangle({1.0, 2.0}, {3.0, 5.0}, 0.0, false));
  EXPECT_TRUE(is_watertight(pit.mesh));
  EXPECT_NEAR(volume_m3(pit.mesh), -9.0, 1e-4);  // inside out
}

TEST(TriangleMesh, KeepsItsPlanCounterClockwise) {
  const Solid solid =
      triangle_mesh({{0, 0, 0}, {0, 1, 0.5}, {1, 0, 0}}, {std::array<std::uint32_t, 3>{0, 1, 2}});
  const auto& corners = solid.blocks.at(0).corners_m;
  const Eigen::Vector2d ab = corners[1] - corners[0];
  const Eigen::Vector2d ac = corners[2] - corners[0];
  EXPECT_GT(ab.x() * ac.y() - ab.y() * ac.x(), 0.0);
  EXPECT_FALSE(solid.blocks[0].has_landmarks);
  EXPECT_DOUBLE_EQ(solid.blocks[0].high_m, 0.5);
}

}  // namespace
}  // namespace roomwise::simulator
