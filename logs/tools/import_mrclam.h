#pragma once
#include <filesystem>
#include <iosfwd>

namespace roomwise {

struct MrclamImport {
  std::filesystem::path folder{};
  std::filesystem::path out{};
  int robot = 1;
  double distance_variance_m2_per_m = 0.005;
  double turn_variance_rad2_per_rad = 0.02;
  double turn_variance_rad2_per_m = 0.01;
  double range_sigma_m = 0.10;
  double range_sigma_per_m = 0.03;  ///< more of it a metre of range
  double bearing_sigma_rad = 0.03;
  double odometry_delay_s = 0.25;   ///< the logged speeds are commands; the robot follows later
  bool unknown_identities = false;  ///< leave it to the filter to tell landmarks apart
};

/// Makes a log of one robot of a UTIAS MRCLAM folder (Leung, Halpern, Barfoot, Liu, IJRR 2011):
/// Robot{N}_{Odometry,Measurement,Groundtruth}.dat, Barcodes.dat, Landmark_Groundtruth.dat.
///
/// ODOMETRY: a record's speed and turn rate hold until the next record, whose time, plus the delay,
/// is the message's. LANDMARKS: all measurements of one instant, identity = subject number;
/// sightings of other robots (subjects 1-5) and unknown barcodes are dropped and counted. TRUTH at
/// its own rate, with the true landmarks once a second. Events in order of time; at equal times
/// ODOMETRY, LANDMARKS, TRUTH. Says on `notes` what it assumed. The same folder gives the same
/// bytes.
///
/// Throws std::runtime_error naming the file (and line) at fault; `out` then stays as it was.
void import_mrclam(const MrclamImport& import, std::ostream& notes);

}  // namespace roomwise
