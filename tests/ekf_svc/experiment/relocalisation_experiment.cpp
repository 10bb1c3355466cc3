// A robot wakes up anywhere in a corridor whose map it has: how far must it drive until it knows
// where it is, and is it ever wrong? And in one that it cannot know its place in: does it guess?
#include <fmt/core.h>

#include <algorithm>
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

struct World {
  std::string name;
  CorridorSettings settings;
  bool wakes_up_elsewhere = false;  // in another corridor of the same kind
  bool can_be_told() const { return !wakes_up_elsewhere && !settings.looks_the_same_turned_round; }
};

struct Tally {
  int starts = 0, found = 0, wrong = 0;
  double way_m = 0.0;
};

void wake_up(CorridorWorld robots, const World& world, const MapSnapshot& map,
             const Pose2& map_start, Tally& tally) {
  robots.start_anywhere();
  Slam slam(corridor_params());
  const Relocaliser relocaliser(map);
  ++tally.starts;
  MapSnapshot local;
  for (int step = 1; step * world.settings.step_m <= kDriveMax_m; ++step) {
    drive_step(robots, slam);
    if (step % 3 != 0) continue;
    slam.filter().save(local);
    const auto place = relocaliser.find(local);
    if (!place) continue;
    if (!slam.resume(map, local, *place)) continue;
    ++tally.found;
    tally.way_m += step * world.settings.step_m;
    const auto error_m = [&] {
      const Pose2 truth = pose_in_map(map, robots, map_start);
      return (slam.filter().pose().position_m() - truth.position_m()).norm();
    };
    if (!world.can_be_told() || error_m() > kWrong_m) ++tally.wrong;
    return;
  }
}

Tally starts_in(const World& world, int starts, int first_seed) {
  Tally tally;
  for (auto seed = static_cast<std::uint64_t>(first_seed); tally.starts < starts; ++seed) {
    CorridorWorld corridor(world.settings, seed);
    const Pose2 start = corridor.truth();
    const MapSnapshot map = mapped(corridor, world.settings);
    constexpr std::uint64_t kElsewhere = 1'000'000;  // no seed of a map
    if (world.wakes_up_elsewhere) corridor = CorridorWorld(world.settings, kElsewhere + seed);
    for (int i = 0; i < kStartsPerMap && tally.starts < starts; ++i) {
      wake_up(corridor, world, map, start, tally);
      corridor.start_anywhere();  // draws on: the next start is another
    }
  }
  return tally;
}

std::vector<World> worlds() {
  std::vector<World> all;
  for (const double spacing_m : {1.2, 0.6}) {
    for (const int classes : {1, 4}) {
      const CorridorSettings settings{.spacing_m = spacing_m, .classes = classes};
      const std::string kinds = classes == 1 ? "all alike" : "4 classes";
      all.push_back({fmt::format("{} m apart, {}", spacing_m, kinds), settings});
    }
  }
  for (const double spacing_m : {1.2, 0.6}) {
    CorridorSettings settings{.spacing_m = spacing_m, .classes = 4};
    settings.missed_ratio = 0.2;
    settings.clutter_per_frame = 0.3;
    all.push_back({fmt::format("{} m apart, ill seen", spacing_m), settings});
  }
  for (const double spacing_m : {1.2, 0.6}) {
    const CorridorSettings settings{.spacing_m = spacing_m};
    CorridorSettings symmetric = settings;
    symmetric.looks_the_same_turned_round = true;
    all.push_back({fmt::format("{} m apart, the same twice", spacing_m), symmetric});
    all.push_back({fmt::format("{} m apart, another one", spacing_m), settings, true});
  }
  return all;
}

}  // namespace

int relocalisation_experiment(int runs, int first_seed) {
  fmt::print("{:28} {:>7} {:>10} {:>7} {:>14}\n", "world", "starts", "found", "wrong",
             "mean way m");
  bool as_promised = true;
  for (const World& world : worlds()) {
    const Tally tally = starts_in(world, runs, first_seed);
    fmt::print("{:28} {:>7} {:>8.1f} % {:>6} {:>14.2f}\n", world.name, tally.starts,
               100.0 * tally.found / tally.starts, tally.wrong,
               tally.way_m / std::max(1, tally.found));
    const double found_min = world.can_be_told() ? 0.95 * tally.starts : 0.0;
    as_promised = as_promised && tally.wrong == 0 && tally.found >= found_min;
  }
  return as_promised ? 0 : 1;
}

}  // namespace roomwise::ekf
