#include "logs/tools/info.h"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <stdexcept>

#include "common/channels.h"
#include "logs/tools/log_replay.h"
#include "logs/tools/subcommands.h"

namespace roomwise {
namespace {

/// From one time to another; a log may hold any times, and their difference may not fit a Duration.
double span_s(Time from, Time to) {
  return 1e-6 * (static_cast<double>(utime_of(to)) - static_cast<double>(utime_of(from)));
}

/// One channel's messages, as they lie in the file.
struct ChannelInfo {
  std::int64_t messages = 0;
  std::uint64_t bytes = 0;
  Time first{};
  Time last{};
  double longest_gap_s = 0.0;
};

using ChannelInfos = std::map<std::string, ChannelInfo, std::less<>>;

void account(const LogEvent& event, ChannelInfo& info) {
  if (info.messages == 0) {
    info.first = event.time;
  } else {
    info.longest_gap_s = std::max(info.longest_gap_s, span_s(info.last, event.time));
  }
  info.last = event.time;
  info.bytes += event.data.size();
  ++info.messages;
}

std::map<std::string, std::string, std::less<>> type_of_channels() {
  std::map<std::string, std::string, std::less<>> types;
  const auto add = [&types]<class Message>(const Channel<Message>& channel) {
    types.emplace(channel.name, Message::getTypeName());
  };
  std::apply([&add](const auto&... channel) { (add(channel), ...); }, kAllChannels);
  return types;
}

void subscribe_all(Bus& bus) {
  std::apply([&bus](const auto&... channel) { (bus.subscribe(channel, [](const auto&) {}), ...); },
             kAllChannels);
}

double rate_hz(const ChannelInfo& info) {
  const double whole_s = span_s(info.first, info.last);
  return whole_s > 0.0 ? static_cast<double>(info.messages - 1) / whole_s : 0.0;
}

std::string time_text(Time time) {
  constexpr Time kYear10000 = time_from_utime(253402300800000000);
  const double time_s = span_s(Time{}, time);
  if (time < Time{} || time >= kYear10000) return fmt::format("{:.6f}", time_s);
  return fmt::format("{:.6f}  {:%Y-%m-%d %H:%M:%S} UTC", time_s,
                     std::chrono::time_point_cast<std::chrono::seconds>(time));
}

std::string summary(const std::filesystem::path& path, const LogReading& reading,
                    const ChannelInfos& infos) {
  std::string text = fmt::format("log       {}\nbytes     {}\n", path.string(), reading.size_bytes);
  if (infos.empty()) return text + "messages  0\n";
  Time first = Time::max();
  Time last = Time::min();
  std::int64_t messages = 0;
  for (const auto& [name, info] : infos) {
    first = std::min(first, info.first);
    last = std::max(last, info.last);
    messages += info.messages;
  }
  return text + fmt::format("messages  {}\nfirst     {}\nlast      {}\nduration  {:.6f} s\n",
                            messages, time_text(first), time_text(last), span_s(first, last));
}

std::string table(const LogReading& reading, const ChannelInfos& infos) {
  constexpr auto kHeader = "{:<14} {:<20} {:>8} {:>9} {:>13} {:>7} {:>8} {:>11} {:>12}\n";
  constexpr auto kRow = "{:<14} {:<20} {:>8} {:>9.2f} {:>13.3f} {:>7} {:>8} {:>11} {:>12}\n";
  const auto types = type_of_channels();
  std::string text = fmt::format(fmt::runtime(kHeader), "channel", "type", "messages", "rate_hz",
                                 "longest_gap_s", "missed", "restarts", "undecodable", "bytes");
  for (const auto& [name, info] : infos) {
    const auto type = types.find(name);
    const auto seen = reading.statistics.channels.find(name);
    const bool counted = seen != reading.statistics.channels.end();
    const ChannelStatistics statistics = counted ? seen->second : ChannelStatistics{};
    text += fmt::format(fmt::runtime(kRow), name, type == types.end() ? "unknown" : type->second,
                        info.messages, rate_hz(info), info.longest_gap_s, statistics.missed,
                        statistics.restarts, statistics.undecodable, info.bytes);
  }
  return text;
}

}  // namespace

LogInfo describe_log(const std::filesystem::path& path) {
  ChannelInfos infos;
  const LogReading reading = replay_log(path, subscribe_all, [&infos](const LogEvent& event) {
    account(event, infos[event.channel]);
  });
  return {summary(path, reading, infos) + table(reading, infos), reading.damage};
}

void add_info(CLI::App& parent) {
  CLI::App& info = *parent.add_subcommand(
      "info", "Channels, types, counts, rates, gaps, undecodable messages, bytes, duration.");
  const auto path = std::make_shared<std::string>();
  info.add_option("LOG", *path, "a log")->required();
  info.callback([path] {
    const LogInfo described = describe_log(*path);
    fmt::print("{}", described.text);
    std::fflush(stdout);
    if (!described.damage.empty()) throw std::runtime_error(described.damage);
  });
}

}  // namespace roomwise
