#include <fmt/core.h>

#include <stdexcept>

#include "logs/tools/log_replay.h"
#include "logs/tools/recording.h"
#include "logs/tools/subcommands.h"
#include "logs/tools/trajectory_file.h"
#include "logs/tools/whole_file.h"

namespace roomwise {
namespace {

struct TrajectoryOptions {
  std::filesystem::path log;
  std::filesystem::path out;
  std::string channel = "POSE";
};

const Trajectory& trajectory_of(const Recording& recording, std::string_view channel) {
  if (channel == channels::kOdometry.name) return recording.odometry;
  if (channel == channels::kTruth.name) return recording.truth;
  return recording.poses;
}

void run_export_trajectory(const TrajectoryOptions& options) {
  Recording recording;
  const LogReading reading = replay_log(options.log, [&](Bus& bus) { gather(bus, recording); });
  sort_by_time(recording);
  const Trajectory& trajectory = trajectory_of(recording, options.channel);
  if (trajectory.empty()) {
    reading.raise_complaints(options.log);
    throw std::runtime_error(fmt::format("{}: holds no {}", options.log.string(), options.channel));
  }
  write_whole_file(options.out, trajectory_as_tum_text(trajectory));
  reading.raise_complaints(options.log);
}

}  // namespace

void add_export_trajectory(CLI::App& parent) {
  CLI::App& command = *parent.add_subcommand("trajectory", "Poses as TUM text.");
  const auto options = std::make_shared<TrajectoryOptions>();
  command.add_option("LOG", options->log, "a log")->required();
  command.add_option("-o", options->out, "text file to write")->required();
  command.add_option("--channel", options->channel, "whose poses")
      ->capture_default_str()
      ->check(CLI::IsMember({"POSE", "ODOMETRY", "TRUTH"}));
  command.callback([options] { run_export_trajectory(*options); });
}

}  // namespace roomwise
