#include "common/service/replay.h"

#include <fmt/format.h>

#include <stdexcept>
#include <tuple>

namespace roomwise {
namespace {

std::filesystem::path unfinished(const std::filesystem::path& path) {
  return path.string() + ".part";
}

/// The service a HEALTH or PARAMS event is about; empty for anything else.
template <class Message>
std::string service_of(const LogEvent& event) {
  Message message;
  return decode(event.data, message) == DecodeResult::kOk ? message.service : std::string();
}

bool publishes(const std::string& service, const std::string& channel) {
  return std::apply(
      [&](const auto&... row) {
        return ((row.name == channel && row.publisher == service) || ...);
      },
      kAllChannels);
}

}  // namespace

Replay::Replay(const std::string& service, const Options& options)
    : service_(service),
      replay_path_(options.replay_path),
      record_path_(options.record_path),
      reader_(options.replay_path) {
  LogBus::Sink sink = [](const LogEvent&) {};
  LogBus::Tap tap;
  if (!record_path_.empty()) {
    std::error_code ignored;
    if (std::filesystem::equivalent(replay_path_, record_path_, ignored)) {
      throw std::runtime_error(record_path_.string() +
                               ": cannot record over the log being replayed");
    }
    writer_ = std::make_unique<LogWriter>(unfinished(record_path_));
    sink = [this](const LogEvent& event) { writer_->write(event); };
    if (!options.outputs_only) tap = [this](const LogEvent& event) { record_input(event); };
  }
  bus_ =
      std::make_unique<LogBus>([this](LogEvent& event) { return reader_.next(event); }, sink, tap);
}

void Replay::record_input(const LogEvent& event) {
  if (!is_own_output(event)) writer_->write(event);
}

/// What an earlier run of this same service left in the log: this run's output replaces it.
bool Replay::is_own_output(const LogEvent& event) const {
  if (event.channel == channels::kHealth.name) return service_of<health_t>(event) == service_;
  if (event.channel == channels::kParams.name) return service_of<params_t>(event) == service_;
  return publishes(service_, event.channel);
}

void Replay::finish() {
  if (writer_) writer_->close();
  if (!bus_->reached_end()) {
    throw std::runtime_error(fmt::format("stopped at byte {} of {} in {}", reader_.position_bytes(),
                                         reader_.size_bytes(), replay_path_.string()));
  }
  if (!writer_) return;
  std::filesystem::rename(unfinished(record_path_), record_path_);
}

bool Replay::input_was_whole() const {
  for (const auto& [channel, seen] : bus_->statistics().channels) {
    if (seen.undecodable > 0) return false;
  }
  return reader_.damage().empty();
}

std::string Replay::summary(double elapsed_s) const {
  std::string text =
      fmt::format("{}: replayed {} in {:.3f} s", service_, replay_path_.string(), elapsed_s);
  for (const auto& [channel, seen] : bus_->statistics().channels) {
    const double total_s = std::chrono::duration<double>(seen.handler_total).count();
    if (seen.received > 0) {
      text += fmt::format("\n{}: {} {} at {:.0f}/s", service_, seen.received, channel,
                          static_cast<double>(seen.received) / total_s);
    }
    if (seen.undecodable > 0) {
      text += fmt::format("\n{}: {} {} undecodable (damaged, or of another version)", service_,
                          seen.undecodable, channel);
    }
  }
  for (const auto& [name, count] : bus_->statistics().counters) {
    text += fmt::format("\n{}: {} {}", service_, count, name);
  }
  if (!reader_.damage().empty()) text += "\n" + reader_.damage_report();
  return text;
}

}  // namespace roomwise
