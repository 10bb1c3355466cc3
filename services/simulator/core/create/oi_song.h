#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "common/time.h"

namespace roomwise::simulator {

/// Songs of the Open Interface: nobody hears them, but packets 36 and 37 tell of them.
class OiSong {
 public:
  /// Opcode 140: number, count, then notes of a pitch and a length in 1/64 s each.
  void define(const std::vector<std::uint8_t>& arguments) {
    int length = 0;
    for (std::size_t i = 3; i < std::min<std::size_t>(arguments.size(), 2 + 2 * kMostNotes);
         i += 2) {
      length += arguments[i];
    }
    lengths_[arguments[0] % lengths_.size()] = length * std::chrono::microseconds(1'000'000) / 64;
  }

  /// Opcode 141: nothing while another song plays.
  void play(std::uint8_t number, Duration now) {
    if (is_playing(now)) return;
    number_ = static_cast<std::uint8_t>(number % lengths_.size());
    ends_ = now + lengths_[number_];
  }

  std::uint8_t number() const { return number_; }
  bool is_playing(Duration now) const { return now < ends_; }

 private:
  static constexpr std::size_t kMostNotes = 16;
  std::array<Duration, 16> lengths_{};
  std::uint8_t number_ = 0;
  Duration ends_{};
};

}  // namespace roomwise::simulator
