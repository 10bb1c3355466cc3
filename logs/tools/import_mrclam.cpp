#include "logs/tools/import_mrclam.h"

#include <fmt/core.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <iostream>
#include <limits>

#include "common/bus/log_file.h"
#include "common/channels.h"
#include "logs/tools/mrclam_messages.h"
#include "logs/tools/option_checks.h"
#include "logs/tools/progress.h"
#include "logs/tools/subcommands.h"
#include "logs/tools/whole_file.h"

namespace roomwise {
namespace {

/// Messages of one channel, waiting for their turn.
template <class Message>
class Queue {
 public:
  Queue(const Channel<Message>& channel, const std::vector<Message>& messages)
      : channel_(channel), messages_(messages) {}

  std::int64_t next_utime() const {
    return next_ < messages_.size() ? messages_[next_].utime
                                    : std::numeric_limits<std::int64_t>::max();
  }

  /// Writes the next message if it is of this time.
  bool write_at(std::int64_t utime, LogWriter& log) {
    if (next_ == messages_.size() || next_utime() != utime) return false;
    log.write(channel_, time_from_utime(utime), messages_[next_++]);
    return true;
  }

 private:
  const Channel<Message>& channel_;
  const std::vector<Message>& messages_;
  std::size_t next_ = 0;
};

/// Writes all queues in order of time; at equal times in the order of the arguments.
template <class... Messages>
void write_merged(LogWriter& log, std::size_t total, Queue<Messages>... queues) {
  Progress progress("import", total);
  for (std::size_t written = 0; written < total; ++written) {
    const std::int64_t utime = std::min({queues.next_utime()...});
    static_cast<void>((queues.write_at(utime, log) || ...));
    progress.show(written);
  }
}

}  // namespace

void import_mrclam(const MrclamImport& import, std::ostream& notes) {
  const MrclamFiles files = read_mrclam(import.folder, import.robot);
  const auto odometry = odometry_messages(import, files.velocities);
  const MrclamSightings sightings = landmark_messages(import, files);
  const auto truth = truth_messages(files);
  fmt::print(notes, "odometry {}\nlandmarks {} in {} messages\ntruth {}\n", odometry.size(),
             sightings.landmarks, sightings.messages.size(), truth.size());
  fmt::print(notes, "dropped: {} sightings of other robots, {} of unknown barcodes\n",
             sightings.other_robots, sightings.unknown_barcodes);
  fmt::print(notes, "assumed: speed and turn rate hold until the next record\n");
  fmt::print(notes, "assumed: the robot follows its record {} s later\n", import.odometry_delay_s);
  fmt::print(notes, "assumed: variance {} m^2/m of distance, {} rad^2/rad + {} rad^2/m of turn\n",
             import.distance_variance_m2_per_m, import.turn_variance_rad2_per_rad,
             import.turn_variance_rad2_per_m);
  fmt::print(notes, "assumed: sigma {} m + {} of range, {} rad of bearing\n", import.range_sigma_m,
             import.range_sigma_per_m, import.bearing_sigma_rad);

  ReplacedFile file(import.out);
  LogWriter log(file.temporary());
  write_merged(log, odometry.size() + sightings.messages.size() + truth.size(),
               Queue(channels::kOdometry, odometry),
               Queue(channels::kLandmarks, sightings.messages), Queue(channels::kTruth, truth));
  log.close();
  file.commit();
}

void add_import_mrclam(CLI::App& parent) {
  CLI::App& command = *parent.add_subcommand("mrclam", "One robot of a UTIAS MRCLAM folder.");
  const auto import = std::make_shared<MrclamImport>();
  command.add_option("DIR", import->folder, "folder of Robot{N}_*.dat")->required();
  command.add_option("--robot", import->robot, "which robot, from 1")->required();
  command.add_option("-o", import->out, "log to write")->required();
  const auto noise = [&command](const char* name, double& value, const char* what) {
    command.add_option(name, value, what)->capture_default_str()->check(positive_number());
  };
  noise("--distance-variance-per-m", import->distance_variance_m2_per_m, "[m^2/m]");
  noise("--turn-variance-per-rad", import->turn_variance_rad2_per_rad, "[rad^2/rad]");
  noise("--turn-variance-per-m", import->turn_variance_rad2_per_m, "[rad^2/m]");
  noise("--range-sigma", import->range_sigma_m, "[m]");
  noise("--range-sigma-per-m", import->range_sigma_per_m, "more of it a metre of range [m/m]");
  noise("--bearing-sigma", import->bearing_sigma_rad, "[rad]");
  noise("--odometry-delay", import->odometry_delay_s, "of the motion behind its record [s]");
  command.add_flag("--unknown-identities", import->unknown_identities,
                   "identity -1: the filter must tell landmarks apart");
  command.callback([import] { import_mrclam(*import, std::cout); });
}

}  // namespace roomwise
