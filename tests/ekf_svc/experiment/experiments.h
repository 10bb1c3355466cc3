#pragma once

namespace roomwise::ekf {

/// Each prints a table on stdout and returns 0 if its bars are met.
int consistency_experiment(int runs);
int association_experiment(int runs);
int calibration_experiment(int runs);
int relocalisation_experiment(int runs);

}  // namespace roomwise::ekf
