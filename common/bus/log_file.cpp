#include "common/bus/log_file.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <span>
#include <stdexcept>

namespace roomwise {
namespace {

constexpr std::uint32_t kSyncWord = 0xEDA1DA01;
constexpr std::uint64_t kHeaderBytes = 28;
constexpr std::uint64_t kLongestChannel = 63;     // LCM's own limit
constexpr std::uint64_t kLargestData = 1U << 28;  // LCM's own limit

template <class Integer>
Integer read_big_endian(std::span<const std::uint8_t> bytes, std::uint64_t at) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(Integer); ++i) value = value << 8U | bytes[at + i];
  return static_cast<Integer>(value);
}

template <class Integer>
std::uint8_t* put_big_endian(std::uint8_t* out, Integer value) {
  for (std::size_t i = sizeof(Integer); i-- > 0;) {
    *out++ = static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i));
  }
  return out;
}

}  // namespace

LogReader::LogReader(const std::filesystem::path& path) : path_(path), file_(path) {}

bool LogReader::next(LogEvent& event) {
  std::uint64_t size = whole_event_at(position_);
  if (size == 0) {
    if (position_ == size_bytes()) return false;
    pass_over_damage();
    size = event_size_at(position_);
    if (size == 0) return false;
  }
  const auto bytes = file_.bytes().subspan(position_, size);
  const auto channel_size = read_big_endian<std::uint32_t>(bytes, 20);
  event.time = time_from_utime(read_big_endian<std::int64_t>(bytes, 12));
  const auto channel = bytes.subspan(kHeaderBytes, channel_size);
  event.channel.assign(channel.begin(), channel.end());
  const auto data = bytes.subspan(kHeaderBytes + channel_size);
  event.data.assign(data.begin(), data.end());
  position_ += size;
  return true;
}

/// Size of the event whose header stands at `byte`, by its own account; 0 if none does.
std::uint64_t LogReader::event_size_at(std::uint64_t byte) const {
  const auto bytes = file_.bytes();
  if (byte > bytes.size() || bytes.size() - byte < kHeaderBytes) return 0;
  if (read_big_endian<std::uint32_t>(bytes, byte) != kSyncWord) return 0;
  const auto channel_size = read_big_endian<std::uint32_t>(bytes, byte + 20);
  const auto data_size = read_big_endian<std::uint32_t>(bytes, byte + 24);
  if (channel_size == 0 || channel_size > kLongestChannel || data_size > kLargestData) return 0;
  const std::uint64_t size = kHeaderBytes + channel_size + data_size;
  return size <= bytes.size() - byte ? size : 0;
}

/// As event_size_at, but not fooled by a damaged length that would swallow the events behind it.
std::uint64_t LogReader::whole_event_at(std::uint64_t byte) const {
  const std::uint64_t size = event_size_at(byte);
  const std::uint64_t end = byte + size;
  if (size == 0 || end == size_bytes() || starts_event(end)) return size;
  return find_event(byte + 1) < end ? 0 : size;
}

std::uint64_t LogReader::find_event(std::uint64_t byte) const {
  const auto bytes = file_.bytes();
  constexpr int kFirstSyncByte = kSyncWord >> 24U;
  while (byte < bytes.size()) {
    const void* found = std::memchr(bytes.data() + byte, kFirstSyncByte, bytes.size() - byte);
    if (found == nullptr) break;
    byte = static_cast<std::uint64_t>(static_cast<const std::uint8_t*>(found) - bytes.data());
    if (starts_event(byte)) return byte;
    ++byte;
  }
  return bytes.size();
}

void LogReader::pass_over_damage() {
  const std::uint64_t resumed = find_event(position_ + 1);
  damage_.push_back({position_, resumed});
  position_ = resumed;
}

std::string LogReader::damage_report() const {
  std::string report;
  for (const LogDamage& damage : damage_) {
    report +=
        fmt::format("{}{}: damaged at byte {}: {} bytes passed over", report.empty() ? "" : "\n",
                    path_.string(), damage.first_byte, damage.resumed_byte - damage.first_byte);
  }
  return report;
}

LogWriter::LogWriter(const std::filesystem::path& path)
    : path_(path), file_(std::fopen(path.c_str(), "wbe")) {
  if (!file_) refuse();
}

void LogWriter::refuse() const {
  throw std::runtime_error(
      fmt::format("{}: cannot write: {}", path_.string(), std::strerror(errno)));
}

void LogWriter::write(const LogEvent& event) {
  std::array<std::uint8_t, kHeaderBytes> header{};
  std::uint8_t* out = put_big_endian(header.data(), kSyncWord);
  out = put_big_endian(out, event_number_++);
  out = put_big_endian(out, utime_of(event.time));
  out = put_big_endian(out, static_cast<std::uint32_t>(event.channel.size()));
  put_big_endian(out, static_cast<std::uint32_t>(event.data.size()));
  std::FILE* file = file_.get();
  const bool written = std::fwrite(header.data(), header.size(), 1, file) == 1 &&
                       std::fwrite(event.channel.data(), event.channel.size(), 1, file) == 1 &&
                       (event.data.empty() ||  // fwrite takes no null pointer, not even for nothing
                        std::fwrite(event.data.data(), event.data.size(), 1, file) == 1);
  if (!written) refuse();
}

void LogWriter::close() {
  if (std::fflush(file_.get()) != 0) refuse();
}

}  // namespace roomwise
