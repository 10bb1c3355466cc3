#include "common/create/boot_text.h"

#include <algorithm>
#include <charconv>
#include <initializer_list>

namespace roomwise::create {
namespace {

bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

/// Takes "NUMBER" and the '.' after it, if any, off the front of `text`.
bool take_number(std::string_view& text, int& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || number < 0) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  if (text.starts_with('.')) text.remove_prefix(1);
  return true;
}

}  // namespace

std::optional<Firmware> firmware_in(std::string_view line) {
  constexpr std::string_view kRelease = "release-";
  const std::size_t found = line.find(kRelease);
  if (found == std::string_view::npos) return std::nullopt;
  line.remove_prefix(found + kRelease.size());
  constexpr std::string_view kBoard = "stm32-";
  if (line.starts_with(kBoard)) line.remove_prefix(kBoard.size());
  Firmware firmware;
  const bool is_whole = take_number(line, firmware.major) && take_number(line, firmware.minor) &&
                        take_number(line, firmware.patch);
  return is_whole ? std::optional(firmware) : std::nullopt;
}

void BootTextReader::accept(std::uint8_t byte) {
  if (byte == '\n' || byte == '\r') return end_line();
  if (byte < ' ' || byte > '~') {
    length_ = 0;  // text does not hold such bytes
  } else if (length_ < kLongestLine) {
    line_[length_++] = static_cast<char>(byte);
  }
}

void BootTextReader::end_line() {
  const std::string_view line(line_.data(), length_);
  const std::initializer_list<std::string_view> marks = {"by iRobot", "bootloader id", "release-",
                                                         "battery-current-zero"};
  if (std::any_of(marks.begin(), marks.end(), [&](auto mark) { return contains(line, mark); })) {
    ++boot_lines_;
  }
  if (const auto firmware = firmware_in(line)) firmware_ = firmware;
  length_ = 0;
}

}  // namespace roomwise::create
