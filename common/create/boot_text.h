#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace roomwise::create {

/// Firmware release of a Create 2, as its boot text names it.
struct Firmware {
  int major = 0;
  int minor = 0;
  int patch = 0;
  friend bool operator==(const Firmware&, const Firmware&) = default;
};

/// The release in a line such as `r3-robot/tags/release-stm32-3.7.7:6913 CLEAN`, if it names one.
std::optional<Firmware> firmware_in(std::string_view line);

/// Recognises the ASCII text a Create 2 prints on its serial line when it boots, among other bytes
/// that belong to no frame.
class BootTextReader {
 public:
  void accept(std::uint8_t byte);

  /// Lines seen that only a booting robot prints; one boot prints several.
  int boot_lines() const { return boot_lines_; }
  const std::optional<Firmware>& firmware() const { return firmware_; }

 private:
  void end_line();

  static constexpr std::size_t kLongestLine = 120;
  std::array<char, kLongestLine> line_{};
  std::size_t length_ = 0;
  int boot_lines_ = 0;
  std::optional<Firmware> firmware_;
};

}  // namespace roomwise::create
