#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iosfwd>

namespace roomwise {

struct SmoothOptions {
  std::filesystem::path log{};
  std::filesystem::path out{};
};

/// The best estimate of a drive in hindsight: writes the log again with POSE and LANDMARK_MAP
/// replaced by the batch estimate, which starts from those in the log and uses ODOMETRY and
/// LANDMARKS whole. Sightings of unknown identity belong to the landmark of the log's last
/// LANDMARK_MAP they are nearest to.
///
/// Throws std::runtime_error naming the file if it holds no ODOMETRY, LANDMARKS, POSE and
/// LANDMARK_MAP, or cannot be read or written.
void smooth_log(const SmoothOptions& options, std::ostream& notes);

/// The subcommand, as those in subcommands.h.
void add_smooth(CLI::App& parent);

}  // namespace roomwise
