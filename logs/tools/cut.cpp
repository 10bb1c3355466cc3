#include "logs/tools/cut.h"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "common/bus/log_file.h"
#include "logs/tools/progress.h"
#include "logs/tools/subcommands.h"
#include "logs/tools/whole_file.h"

namespace roomwise {
namespace {

bool holds(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

bool is_wanted(const LogCut& cut, const LogEvent& event, Time start) {
  // A hostile log may hold any times: their difference need not fit a Duration.
  const double at_s =
      1e-6 * (static_cast<double>(utime_of(event.time)) - static_cast<double>(utime_of(start)));
  return at_s >= cut.from_s && (!cut.to_s || at_s < *cut.to_s) &&
         (cut.channels.empty() || holds(cut.channels, event.channel)) &&
         !holds(cut.without, event.channel);
}

}  // namespace

std::uint64_t cut_log(const LogCut& cut) {
  LogReader reader(cut.log);
  ReplacedFile file(cut.out);
  LogWriter log(file.temporary());
  Progress progress("cut", reader.size_bytes());
  LogEvent event;
  std::optional<Time> start;
  std::uint64_t kept = 0;
  while (reader.next(event)) {
    progress.show(reader.position_bytes());
    if (!start) start = event.time;
    if (!is_wanted(cut, event, *start)) continue;
    log.write(event);
    ++kept;
  }
  log.close();
  if (kept > 0) file.commit();
  if (const std::string damage = reader.damage_report(); !damage.empty()) {
    throw std::runtime_error(damage);
  }
  if (kept == 0) {
    throw std::runtime_error(fmt::format("{}: nothing in it is asked for", cut.log.string()));
  }
  return kept;
}

void add_cut(CLI::App& parent) {
  CLI::App& command = *parent.add_subcommand("cut", "A part of a log: a time, some channels.");
  const auto cut = std::make_shared<LogCut>();
  command.add_option("LOG", cut->log, "a log")->required();
  command.add_option("-o", cut->out, "log to write")->required();
  command.add_option("--from", cut->from_s, "after the first message [s]")->capture_default_str();
  command.add_option("--to", cut->to_s, "after the first message [s]; else to the end");
  auto* channels = command.add_option("--channels", cut->channels, "only these: A,B,...");
  channels->delimiter(',');
  command.add_option("--without", cut->without, "not these: A,B,...")
      ->delimiter(',')
      ->excludes(channels);
  command.callback([cut] { fmt::print("kept {} messages\n", cut_log(*cut)); });
}

}  // namespace roomwise
