#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/geometry/pose2.h"
#include "services/safety_svc/core/instant.h"

namespace roomwise::safety {

/// What ODOMETRY says.
struct OdometrySample {
  Time time{};  ///< end of the interval
  Duration interval{};
  double distance_m = 0.0;
  double turn_rad = 0.0;
  Pose2 T_odom_robot;
  int reset_counter = 0;
};

enum class OdometryResult : std::uint8_t {
  kUsed,
  kStartedAnew,  ///< used; what was remembered in the old odom frame is worthless
  kRefused,      ///< not finite, no interval, or faster than any Create: nothing changed
};

/// Where the robot is and lately was in the odom frame. Fixed size.
class OdometryTrack {
 public:
  [[nodiscard]] OdometryResult add(const Instant& now, const OdometrySample& sample);

  /// The pose at `time`, between samples or up to 0.2 s past the newest at its speed; nothing
  /// beyond, or before the oldest.
  std::optional<Pose2> pose_at(Time time) const;

  /// The pose now: the newest, moved on at its speed for as long as it is old.
  Pose2 pose_now(const Instant& now) const;

  double speed_mps() const { return speed_mps_; }
  double turn_rate_radps() const { return turn_rate_radps_; }
  bool stands() const;

  /// How far the robot can go back along an arc of `curvature_radpm` [1/m] and stay where it came
  /// from, kReverse_m at most. Shrinks by what is driven back, and with time.
  double reverse_way_m(const Instant& now, double curvature_radpm) const;

 private:
  struct Mark {
    Pose2 T_odom_robot;
    Duration passed{};
  };
  static constexpr std::size_t kSamples = 64;  // a second of a Create 2
  static constexpr std::size_t kMarks = 32;    // one every kMarkStep_m: more than kReverse_m

  void start_anew();
  void leave_mark(const Instant& now, const Pose2& pose);
  bool is_near_track(const Instant& now, const Pose2& pose) const;
  const OdometrySample& newest(std::size_t back) const {
    return samples_[(count_ - 1 - back) % kSamples];
  }

  std::array<OdometrySample, kSamples> samples_{};
  std::size_t count_ = 0;  // of samples ever added since the start
  Duration received_{};
  double speed_mps_ = 0.0;
  double turn_rate_radps_ = 0.0;
  std::array<Mark, kMarks> marks_{};
  std::size_t mark_count_ = 0;  // ever left since the start
};

}  // namespace roomwise::safety
