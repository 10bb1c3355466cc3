// LandmarkService on a run of KINECT_FRAME and ODOMETRY messages as they come off the wire. Each
// is a byte that says which (odd: odometry), its length as two bytes, low one first, and its bytes.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "common/bus/log_bus.h"
#include "services/landmark_svc/landmark_service.h"
#include "tests/fuzz/fingerprint.h"

namespace {

using namespace roomwise;

template <class Message>
LogEvent event_of(const Channel<Message>& channel, std::span<const std::uint8_t> bytes) {
  LogEvent event;
  event.channel = channel.name;
  event.data.assign(bytes.begin(), bytes.end());
  set_fingerprint<Message>(event.data);
  return event;
}

std::vector<LogEvent> events_of(std::span<const std::uint8_t> bytes) {
  std::vector<LogEvent> events;
  while (bytes.size() >= 3) {
    const bool is_odometry = bytes[0] % 2 == 1;
    const auto told = static_cast<std::size_t>(bytes[1] + 256 * bytes[2]);
    bytes = bytes.subspan(3);
    const auto message = bytes.first(std::min(told, bytes.size()));
    bytes = bytes.subspan(message.size());
    events.push_back(is_odometry ? event_of(channels::kOdometry, message)
                                 : event_of(channels::kKinectFrame, message));
  }
  return events;
}

bool is_covariance(const landmark_observation_t& seen) {
  const double rr = seen.covariance_range_range_m2;
  const double bb = seen.covariance_bearing_bearing_rad2;
  const double rb = seen.covariance_range_bearing_m_rad;
  return std::isfinite(rr) && std::isfinite(bb) && rr > 0.0 && bb > 0.0 && rb * rb < rr * bb;
}

bool is_whole(const landmark_observation_t& seen) {
  const bool is_place = std::isfinite(seen.range_m) && seen.range_m > 0.0 &&
                        std::abs(seen.bearing_rad) <= std::numbers::pi;
  const bool is_span = seen.height_low_m <= seen.height_high_m && std::isfinite(seen.step_m);
  return is_place && is_span && is_covariance(seen) && seen.score_ratio >= 0.0 &&
         seen.score_ratio <= 1.0;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::vector<LogEvent> input = events_of({data, size});
  std::vector<LogEvent> output;
  LogBus bus(input, output);
  LandmarkService service(bus, {});
  bus.run();
  for (const LogEvent& event : output) {
    landmark_list_t list;
    if (decode(event.data, list) != DecodeResult::kOk) __builtin_trap();
    if (!std::ranges::all_of(list.landmarks, is_whole)) __builtin_trap();
  }
  return 0;
}
