// slam_experiment NAME [RUNS [FIRST_SEED]]: statistics over many seeded runs, too long for a test.
#include <fmt/core.h>

#include <cstdlib>
#include <functional>
#include <map>
#include <string>

#include "tests/ekf_svc/experiment/experiments.h"

int main(int argc, char** argv) {
  using namespace roomwise::ekf;
  const std::map<std::string, std::function<int(int, int)>> experiments{
      {"consistency", consistency_experiment},
      {"association", association_experiment},
      {"calibration", calibration_experiment},
      {"relocalisation", relocalisation_experiment}};
  const auto found = argc >= 2 ? experiments.find(argv[1]) : experiments.end();
  if (found == experiments.end()) {
    fmt::print(stderr, "usage: slam_experiment NAME [RUNS [FIRST_SEED]]; NAME:");
    for (const auto& [name, run] : experiments) fmt::print(stderr, " {}", name);
    fmt::print(stderr, "\n");
    return 2;
  }
  return found->second(argc > 2 ? std::atoi(argv[2]) : 100, argc > 3 ? std::atoi(argv[3]) : 1);
}
