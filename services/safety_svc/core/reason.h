#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace roomwise::safety {

/// Why the robot may not move as asked. The numbers are those of VEL_CMD.
enum class Reason : std::uint8_t {
  kAsAsked,
  kNoRequest,
  kBadRequest,
  kEstop,
  kNoCamera,
  kNoOdometry,
  kNoCreateState,
  kClock,
  kMode,
  kBump,
  kCliff,
  kWheelDrop,
  kWall,
  kOvercurrent,
  kTilt,
  kObstacle,
  kRemembered,
  kDropOff,
  kUnknown,
  kReverse,
  kAcceleration,
  kSpeedLimit,
  kCharging,
};
inline constexpr std::size_t kReasons = 23;

constexpr std::string_view words_of(Reason reason) {
  constexpr std::array<std::string_view, kReasons> kWords = {
      "as asked",
      "nobody asks",
      "the request makes no sense",
      "emergency stop",
      "no camera",
      "no odometry",
      "nothing heard from the robot",
      "a clock jumped or a stamp is from the future",
      "the robot is not in a mode that drives",
      "bumper pressed",
      "cliff",
      "wheel hangs",
      "wall sensor",
      "wheel overcurrent",
      "the camera is not where it was mounted",
      "obstacle",
      "obstacle seen before",
      "the floor ends",
      "the way cannot be seen",
      "the way back is not known",
      "accelerating",
      "faster than allowed",
      "charging"};
  return kWords[static_cast<std::size_t>(reason)];
}

/// Some reasons, each once.
class ReasonSet {
 public:
  void add(Reason reason) { bits_ |= bit_of(reason); }
  void add(const ReasonSet& others) { bits_ |= others.bits_; }
  bool has(Reason reason) const { return (bits_ & bit_of(reason)) != 0; }
  bool is_empty() const { return bits_ == 0; }
  /// The one of the smallest number; kAsAsked if there is none.
  Reason first() const {
    return is_empty() ? Reason::kAsAsked : static_cast<Reason>(std::countr_zero(bits_));
  }
  friend bool operator==(const ReasonSet&, const ReasonSet&) = default;

 private:
  static std::uint32_t bit_of(Reason reason) { return 1U << static_cast<unsigned>(reason); }
  std::uint32_t bits_ = 0;
};

}  // namespace roomwise::safety
