#pragma once
#include <cstdint>

namespace roomwise::kinect {

/// Device time to host time by a running minimum.
///
/// A frame taken at device time d arrives at host time h = d + offset + delay with delay >= 0 that
/// jumps about; the smallest h - d seen is the offset plus the smallest delay. So that crystals may
/// drift apart (some 50 us a second), the minimum is taken over the present window of device time
/// and the one before it. As in Olson, "A passive solution to the sensor synchronization problem",
/// IROS 2010, with windows in place of a drift bound.
///
/// A clock that starts anew (the device's or the host's) shows as a device time that runs backwards
/// or as a delay beyond any a live stream has; then the past is forgotten.
class ClockMapping {
 public:
  struct Params {
    std::int64_t window_us = 10'000'000;
    std::int64_t delay_max_us = 2'000'000;  ///< later than that after the earliest: clocks changed
    std::int64_t exposure_delay_us = 0;     ///< smallest delay from mid-exposure to arrival
  };

  explicit ClockMapping(const Params& params) : params_(params) {}

  /// Host time at which the frame of `device_time_us` was taken, which arrived at `host_time_us`;
  /// both in order of arrival. Later than for the frame before, whatever the clocks do, unless the
  /// host's clock was set back; at most `host_time_us` but for keeping that order. O(1).
  std::int64_t map(std::int64_t device_time_us, std::int64_t host_time_us);

  /// Host time minus device time as presently estimated.
  std::int64_t offset_us() const { return offset_us_; }
  /// Times a clock started anew.
  std::int64_t restarts() const { return restarts_; }

 private:
  bool started_anew(std::int64_t device_time_us, std::int64_t offset_us) const;
  void restart(std::int64_t device_time_us, std::int64_t offset_us);

  Params params_;
  bool started_ = false;
  std::int64_t last_device_us_ = 0;
  std::int64_t last_mapped_us_ = 0;
  std::int64_t window_start_us_ = 0;  ///< device time
  std::int64_t present_min_us_ = 0;
  std::int64_t past_min_us_ = 0;
  std::int64_t offset_us_ = 0;
  std::int64_t restarts_ = 0;
};

}  // namespace roomwise::kinect
