#include "services/kinect_pub/core/clock_mapping.h"

#include <algorithm>

namespace roomwise::kinect {
namespace {

/// Clocks beyond this are nonsense (9000 years), and sums of them could overflow.
constexpr std::int64_t kLatest_us = 300'000'000'000'000'000;

std::int64_t sane(std::int64_t time_us) { return std::clamp(time_us, -kLatest_us, kLatest_us); }

}  // namespace

bool ClockMapping::started_anew(std::int64_t device_time_us, std::int64_t offset_us) const {
  if (device_time_us < last_device_us_) return true;
  const std::int64_t change_us = offset_us - offset_us_;
  return change_us > params_.delay_max_us || change_us < -params_.delay_max_us;
}

void ClockMapping::restart(std::int64_t device_time_us, std::int64_t offset_us) {
  window_start_us_ = device_time_us;
  present_min_us_ = offset_us;
  past_min_us_ = offset_us;
  if (started_) ++restarts_;
  started_ = true;
}

std::int64_t ClockMapping::map(std::int64_t device_time_us, std::int64_t host_time_us) {
  device_time_us = sane(device_time_us);
  host_time_us = sane(host_time_us);
  const std::int64_t offset_us = host_time_us - device_time_us;
  if (!started_ || started_anew(device_time_us, offset_us)) restart(device_time_us, offset_us);
  if (device_time_us - window_start_us_ >= params_.window_us) {
    past_min_us_ = present_min_us_;
    present_min_us_ = offset_us;
    window_start_us_ = device_time_us;
  }
  present_min_us_ = std::min(present_min_us_, offset_us);
  offset_us_ = std::min(present_min_us_, past_min_us_);
  last_device_us_ = device_time_us;

  const std::int64_t mapped_us = device_time_us + offset_us_ - params_.exposure_delay_us;
  const bool host_set_back = host_time_us < last_mapped_us_ - params_.delay_max_us;
  last_mapped_us_ = host_set_back ? mapped_us : std::max(mapped_us, last_mapped_us_ + 1);
  return last_mapped_us_;
}

}  // namespace roomwise::kinect
