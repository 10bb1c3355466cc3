#pragma once

namespace roomwise::ekf {

/// Each prints a table on stdout and returns 0 if its bars are met. `first_seed`: of the worlds.
int consistency_experiment(int runs, int first_seed);
int association_experiment(int runs, int first_seed);
int calibration_experiment(int runs, int first_seed);
int relocalisation_experiment(int runs, int first_seed);

}  // namespace roomwise::ekf
