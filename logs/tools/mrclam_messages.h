#pragma once
#include <vector>

#include "logs/tools/import_mrclam.h"
#include "logs/tools/mrclam_files.h"
#include "roomwise/landmark_list_t.hpp"
#include "roomwise/odometry_t.hpp"
#include "roomwise/truth_t.hpp"

namespace roomwise {

/// A message for each interval, if not of length 0, between two velocity records.
std::vector<odometry_t> odometry_messages(const MrclamImport& import,
                                          const std::vector<MrclamVelocity>& velocities);

struct MrclamSightings {
  std::vector<landmark_list_t> messages;  ///< instants without a landmark have none
  std::int64_t landmarks = 0;
  std::int64_t other_robots = 0;      ///< dropped
  std::int64_t unknown_barcodes = 0;  ///< dropped
};
MrclamSightings landmark_messages(const MrclamImport& import, const MrclamFiles& files);

/// A message a pose; the landmarks go with the first, and again after each second.
std::vector<truth_t> truth_messages(const MrclamFiles& files);

}  // namespace roomwise
