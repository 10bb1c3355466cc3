// A robot wakes up anywhere in a corridor whose map it has: how far must it drive until it knows
// where it is, and is it ever wrong?
#include <fmt/core.h>

#include <cmath>
#include <string>

#include "services/ekf_svc/core/slam.h"
#include "tests/ekf_svc/experiment/experiments.h"
#include "tests/ekf_svc/support/corridor_world.h"
#include "tests/ekf_svc/support/mrclam.h"

namespace roomwise::ekf {
namespace {

constexpr int kStartsPerMap = 10;
constexpr double kDriveMax_m = 4.0;
constexpr double kWrong_m = 0.3;

EkfParams corridor_params() {
  EkfParams params;
  params.range_bias_m = params.lateral_bias_m = 0.0;
  params.self_calibration = false;
  params.landmark_budget = 600;
  return params;
}

void drive_step(CorridorWorld& world, Slam& slam) {
  slam.predict(world.drive());
  std::vector<Sighting> sightings;
  for (const auto& seen : world.look()) sightings.push_back(seen.sighting);
  std::vector<Verdict> verdicts(sightings.size());
  slam.process(sightings, true, verdicts);
}

MapSnapshot mapped(CorridorWorld& world, const CorridorSettings& settings) {
  Slam slam(corridor_params());
  const int steps = static_cast<int>(2.0 * world.lap_m() / settings.step_m);
  for (int i = 0; i < steps; ++i) drive_step(world, slam);
  MapSnapshot map;
  slam.filter().save(map);
  return map;
}

/// Where the robot is in the map's frame, as the landmarks around it say.
Pose2 pose_in_map(const MapSnapshot& map, const CorridorWorld& world, const Pose2& start) {
  std::vector<Eigen::Vector2d> from, to;
  for (const Eigen::Vector2d& landmark : world.landmarks()) {
    if ((landmark - world.truth().position_m()).norm() > 5.0) continue;
    const Eigen::Vector2d p = transform(inverse(start), landmark);
    for (const Eigen::Vector2d& mapped_m : map.positions_m) {
      if ((mapped_m - p).norm() > 0.4) continue;
      from.push_back(landmark);
      to.push_back(mapped_m);
      break;
    }
  }
  return compose(mrclam::rigid_fit(from, to), world.truth());
}

struct Tally {
  int starts = 0, found = 0, wrong = 0;
  double way_m = 0.0;
};

void wake_up(CorridorWorld world, const MapSnapshot& map, const Pose2& map_start,
             const CorridorSettings& settings, Tally& tally) {
  world.start_anywhere();
  Slam slam(corridor_params());
  const Relocaliser relocaliser(map);
  ++tally.starts;
  MapSnapshot local;
  for (int step = 1; step * settings.step_m <= kDriveMax_m; ++step) {
    drive_step(world, slam);
    if (step % 3 != 0) continue;
    slam.filter().save(local);
    const auto place = relocaliser.find(local);
    if (!place) continue;
    if (!slam.resume(map, local, *place)) continue;
    const Pose2 truth = pose_in_map(map, world, map_start);
    ++tally.found;
    tally.way_m += step * settings.step_m;
    if ((slam.filter().pose().position_m() - truth.position_m()).norm() > kWrong_m) ++tally.wrong;
    return;
  }
}

}  // namespace

int relocalisation_experiment(int runs) {
  struct World {
    std::string name;
    double spacing_m;
    int classes;
  };
  fmt::print("{:28} {:>7} {:>10} {:>7} {:>14}\n", "world", "starts", "found", "wrong",
             "mean way m");
  bool as_promised = true;
  for (const World& world :
       {World{"1.2 m apart, all alike", 1.2, 1}, World{"1.2 m apart, 4 classes", 1.2, 4},
        World{"0.6 m apart, all alike", 0.6, 1}, World{"0.6 m apart, 4 classes", 0.6, 4}}) {
    CorridorSettings settings;
    settings.spacing_m = world.spacing_m;
    settings.classes = world.classes;
    Tally tally;
    for (int seed = 1; tally.starts < runs; ++seed) {
      CorridorWorld corridor(settings, static_cast<std::uint64_t>(seed));
      const Pose2 start = corridor.truth();
      const MapSnapshot map = mapped(corridor, settings);
      for (int i = 0; i < kStartsPerMap && tally.starts < runs; ++i) {
        wake_up(corridor, map, start, settings, tally);
        corridor.start_anywhere();  // draws on: the next start is another
      }
    }
    fmt::print("{:28} {:>7} {:>8.1f} % {:>6} {:>14.2f}\n", world.name, tally.starts,
               100.0 * tally.found / tally.starts, tally.wrong, tally.way_m / tally.found);
    as_promised = as_promised && tally.wrong == 0 && tally.found >= 0.95 * tally.starts;
  }
  return as_promised ? 0 : 1;
}

}  // namespace roomwise::ekf
