#pragma once
#include <array>
#include <cstdint>
#include <optional>

#include "common/geometry/pose2.h"
#include "roomwise/odometry_t.hpp"

namespace roomwise {

/// The last poses of ODOMETRY, to be asked for the one at a frame's time.
class OdometryTrack {
 public:
  enum class Result { kOk, kNotUsable, kStartedAnew };

  /// Takes a message. kNotUsable: a number that is not finite or farther than 1000 km, or a time
  /// that is absurd. kStartedAnew: another reset_counter, or time went back; all before is
  /// forgotten.
  [[nodiscard]] Result take(const odometry_t& message);

  /// Between the two poses around `utime`; up to 0.1 s beyond the newest its own motion goes on.
  /// Nothing outside of that.
  std::optional<Pose2> at(std::int64_t utime) const;

 private:
  struct Entry {
    std::int64_t utime = 0;
    Pose2 pose;
  };
  static constexpr std::size_t kMost = 64;
  const Entry& newest(std::size_t back) const {
    return entries_[(next_ + kMost - 1 - back) % kMost];
  }

  std::array<Entry, kMost> entries_;
  std::size_t next_ = 0;
  std::size_t known_ = 0;
  std::int32_t reset_counter_ = 0;
};

}  // namespace roomwise
