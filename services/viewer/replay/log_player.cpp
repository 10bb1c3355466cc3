#include "services/viewer/replay/log_player.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include "common/channels.h"

namespace roomwise::viewer {
namespace {

namespace fs = std::filesystem;

void add_logs(const fs::path& folder, const fs::path& prefix, std::vector<std::string>& names) {
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(folder, unreadable)) {
    if (entry.is_regular_file(unreadable) && entry.path().extension() == ".lcmlog") {
      names.push_back((prefix / entry.path().filename()).string());
    } else if (prefix.empty() && entry.is_directory(unreadable)) {
      add_logs(entry.path(), entry.path().filename(), names);
    }
  }
}

}  // namespace

std::vector<std::string> log_names(const fs::path& folder) {
  std::vector<std::string> names;
  add_logs(folder, {}, names);
  std::ranges::sort(names);
  return names;
}

LogPlayer::LogPlayer(const fs::path& path, Sink sink) : reader_(path), sink_(std::move(sink)) {
  for (std::uint64_t byte = reader_.position_bytes(); reader_.next(event_);
       byte = reader_.position_bytes()) {
    index_.push_back({event_.time, byte, number_of(event_.channel)});
  }
  if (index_.empty()) throw std::runtime_error(path.string() + " holds no messages");
  std::ranges::stable_sort(index_, {}, &Entry::time);
}

std::uint16_t LogPlayer::number_of(const std::string& channel) {
  const auto found = std::ranges::find(channels_, channel);
  if (found == channels_.end() && channels_.size() < 0xFFFF) {
    channels_.push_back(channel);
    return static_cast<std::uint16_t>(channels_.size() - 1);
  }
  return static_cast<std::uint16_t>(found - channels_.begin());
}

double LogPlayer::length_s() const { return seconds_at(index_.size() - 1); }

double LogPlayer::seconds_at(std::size_t entry) const {
  return seconds(index_[entry].time - index_.front().time);
}

void LogPlayer::hand_out(std::size_t entry) {
  reader_.go_to(index_[entry].byte);
  if (reader_.next(event_)) sink_(event_);
}

void LogPlayer::advance_to(double position_s) {
  while (!at_end() && seconds_at(next_) <= position_s) hand_out(next_++);
  position_s_ = std::clamp(position_s, 0.0, length_s());
}

void LogPlayer::seek(double position_s) {
  next_ = 0;
  while (!at_end() && seconds_at(next_) <= position_s) ++next_;
  std::set<std::uint16_t> seen;
  std::vector<std::size_t> newest;
  for (std::size_t i = next_; i > 0 && seen.size() < channels_.size(); --i) {
    if (seen.insert(index_[i - 1].channel).second) newest.push_back(i - 1);
  }
  for (auto entry = newest.rbegin(); entry != newest.rend(); ++entry) hand_out(*entry);
  position_s_ = std::clamp(position_s, 0.0, length_s());
}

void LogPlayer::step() {
  const auto frames = std::ranges::find(channels_, channels::kKinectFrame.name);
  const auto number = static_cast<std::uint16_t>(frames - channels_.begin());
  while (!at_end()) {
    const std::size_t entry = next_++;
    hand_out(entry);
    position_s_ = seconds_at(entry);
    if (index_[entry].channel == number) return;
  }
}

}  // namespace roomwise::viewer
