#include <fmt/core.h>

#include "logs/tools/image_file.h"
#include "logs/tools/log_replay.h"
#include "logs/tools/map_picture.h"
#include "logs/tools/subcommands.h"

namespace roomwise {
namespace {

struct MapPngOptions {
  std::filesystem::path log;
  std::filesystem::path out;
  std::string title;
};

void run_export_map_png(const MapPngOptions& options) {
  Recording recording;
  const LogReading reading = replay_log(options.log, [&](Bus& bus) { gather(bus, recording); });
  sort_by_time(recording);
  const std::string title = options.title.empty() ? options.log.stem().string() : options.title;
  write_png(options.out, draw_map(recording, title));
  reading.raise_complaints(options.log);
}

}  // namespace

void add_export_map_png(CLI::App& parent) {
  CLI::App& command = *parent.add_subcommand("map-png", "The map and the paths, seen from above.");
  const auto options = std::make_shared<MapPngOptions>();
  command.add_option("LOG", options->log, "a log")->required();
  command.add_option("-o", options->out, "PNG to write")->required();
  command.add_option("--title", options->title, "instead of the log's name");
  command.callback([options] { run_export_map_png(*options); });
}

}  // namespace roomwise
