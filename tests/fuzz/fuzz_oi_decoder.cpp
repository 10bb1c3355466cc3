// The Create's decoder, odometry and driver on any bytes: frames found do not depend on how the
// bytes are split, poses stay finite, and the driver sends what the Open Interface knows.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "services/create_driver/core/create_driver.h"

namespace {

using namespace roomwise::create;
using Input = std::span<const std::uint8_t>;

constexpr std::uint8_t kEverything[] = {100};

std::vector<int> frames_of(Input bytes, std::size_t piece) {
  OiDecoder decoder(kEverything);
  std::vector<int> seen;
  while (!bytes.empty()) {
    const Input now = bytes.first(std::min(piece, bytes.size()));
    decoder.push(now, [&](const StreamFrame& frame) {
      seen.push_back(frame.packets[Packet::kEncoderLeft]);
      seen.push_back(static_cast<int>(frame.gap_size));
    });
    bytes = bytes.subspan(now.size());
  }
  return seen;
}

void check_report(const FrameReport& report) {
  if (!report.odometry) return;
  const auto& pose = report.odometry->T_odom_robot;
  const bool is_finite = std::isfinite(pose.x_m) && std::isfinite(pose.y_m) &&
                         std::isfinite(pose.heading_rad) && report.odometry->covariance.allFinite();
  if (!is_finite || report.odometry->interval.count() <= 0) __builtin_trap();
}

/// First byte: model. Then pieces of the stream, each after a byte with its length and the time.
void drive(Input bytes) {
  CreateParams params;
  params.model = bytes[0] % 2 == 0 ? "create2" : "create1";
  CreateDriver driver(params);
  roomwise::create::Instant now{std::chrono::hours(1),
                                roomwise::time_from_utime(1'700'000'000'000'000)};
  driver.port_opened(now);
  bytes = bytes.subspan(1);
  while (!bytes.empty()) {
    const std::uint8_t control = bytes[0];
    bytes = bytes.subspan(1);
    const std::size_t size = std::min<std::size_t>(control, bytes.size());
    const auto step = std::chrono::milliseconds(control % 8 == 7 ? 400 : 5);
    now.steady += step;
    now.wall += step;
    driver.step(now, bytes.first(size));
    for (const FrameReport& report : driver.reports()) check_report(report);
    bytes = bytes.subspan(size);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const Input bytes(data, size);
  if (frames_of(bytes, size) != frames_of(bytes, 1 + data[0] % 7)) __builtin_trap();
  drive(bytes);
  return 0;
}
