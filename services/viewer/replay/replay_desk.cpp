#include "services/viewer/replay/replay_desk.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace roomwise::viewer {
namespace {

constexpr double kSlowest_ratio = 0.05;
constexpr double kFastest_ratio = 20.0;

/// Not finite if it is no number.
double number_in(std::string_view text) {
  double value = NAN;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() ? value : NAN;
}

}  // namespace

std::string json_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      out += ' ';
    } else {
      out += c;
    }
  }
  return out + '"';
}

ReplayDesk::ReplayDesk(std::filesystem::path folder, LogPlayer::Sink sink)
    : folder_(std::move(folder)), sink_(std::move(sink)) {}

std::string ReplayDesk::follow(std::string_view order, Clock::time_point now) {
  const std::size_t space = std::min(order.find(' '), order.size());
  const std::string_view verb = order.substr(0, space);
  const std::string_view rest = order.substr(std::min(space + 1, order.size()));
  std::string refusal;
  if (verb == "open") {
    refusal = open(rest);
  } else if (verb == "live") {
    player_.reset();
  } else {
    refusal = player_ ? follow_in_replay(verb, rest) : "no log is open";
  }
  start_counting(now);
  return refusal;
}

std::string ReplayDesk::open(std::string_view name) {
  const auto names = log_names(folder_);
  if (std::ranges::find(names, name) == names.end()) return "no such log";
  try {
    player_.emplace(folder_ / name, sink_);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  name_ = name;
  playing_ = true;
  player_->seek(0.0);
  return {};
}

std::string ReplayDesk::follow_in_replay(std::string_view verb, std::string_view rest) {
  const double value = number_in(rest);
  if (verb == "play" || verb == "pause") {
    playing_ = verb == "play";
    if (playing_ && player_->at_end()) player_->seek(0.0);
  } else if (verb == "step") {
    playing_ = false;
    player_->step();
  } else if (verb == "seek" && std::isfinite(value)) {
    player_->seek(value);
  } else if (verb == "speed" && std::isfinite(value)) {
    speed_ratio_ = std::clamp(value, kSlowest_ratio, kFastest_ratio);
  } else {
    return "not an order";
  }
  return {};
}

void ReplayDesk::start_counting(Clock::time_point now) {
  counted_from_ = now;
  position_from_s_ = player_ ? player_->position_s() : 0.0;
}

void ReplayDesk::play(Clock::time_point now) {
  if (!is_playing()) return;
  const double elapsed_s = std::chrono::duration<double>(now - counted_from_).count();
  player_->advance_to(position_from_s_ + speed_ratio_ * elapsed_s);
  if (player_->at_end()) playing_ = false;
}

std::string ReplayDesk::status() const {
  if (!player_) return R"("mode":"live")";
  return fmt::format(
      R"("mode":"replay","log":{},"position_s":{:.3f},"length_s":{:.3f},"playing":{},"speed":{})",
      json_text(name_), player_->position_s(), player_->length_s(), playing_, speed_ratio_);
}

}  // namespace roomwise::viewer
