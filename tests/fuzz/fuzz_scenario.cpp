// read_scenario() on any text: it is refused with the file's name, or gives a scene whose numbers
// are finite, whose indices are in range and whose paths can be driven.
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

#include "services/simulator/core/ground_plan.h"
#include "services/simulator/core/path_plan.h"
#include "services/simulator/scenario/scenario.h"

namespace {

using roomwise::simulator::Mesh;
using roomwise::simulator::Scene;

void expect(bool holds) {
  if (!holds) __builtin_trap();
}

void check_mesh(const Mesh& mesh, const Scene& scene) {
  expect(mesh.material >= 0 && static_cast<std::size_t>(mesh.material) < scene.materials.size());
  expect(mesh.texture_m.size() == mesh.corners_m.size());
  for (const auto& corner : mesh.corners_m) expect(corner.allFinite());
  for (const auto& triangle : mesh.triangles) {
    for (const auto index : triangle) expect(index < mesh.corners_m.size());
  }
}

void check_scene(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) check_mesh(mesh, scene);
  for (const auto& walker : scene.walkers) {
    for (const Mesh& mesh : walker.meshes) check_mesh(mesh, scene);
    expect(walker_pose(walker, 1e4).position_m().allFinite());
  }
  for (const auto& landmark : scene.landmarks) expect(landmark.position_m.allFinite());
  const auto plan = roomwise::simulator::ground_plan(scene, 1.0);
  expect(!std::isnan(roomwise::simulator::clearance_m(plan, scene.start.position_m())));
  for (const auto& path : scene.paths) {
    const roomwise::simulator::DrivePlan drive(scene.start, path);
    expect(std::isfinite(drive.duration_s()));
    expect(drive.at(drive.duration_s() / 2).pose.position_m().allFinite());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view toml(reinterpret_cast<const char*>(data), size);
  try {
    check_scene(roomwise::simulator::read_scenario(toml, "fuzz.toml").scene);
  } catch (const std::runtime_error& error) {
    expect(std::string_view(error.what()).starts_with("fuzz.toml:"));
  }
  return 0;
}
