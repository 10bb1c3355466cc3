// A saved map of any bytes: refused with a reason, or a map that gives the same bytes again and
// that a robot can be lost in.
#include <zlib.h>

#include <cstdint>
#include <span>
#include <vector>

#include "services/ekf_svc/core/estimator.h"
#include "services/ekf_svc/core/map_codec.h"

namespace {

using namespace roomwise::ekf;
using Bytes = std::vector<std::uint8_t>;

void append(std::uint64_t value, int bytes, Bytes& out) {
  for (int i = 0; i < bytes; ++i) out.push_back(static_cast<std::uint8_t>(value >> 8 * i));
}

/// The fuzzer's bytes in a whole file: without a right size and checksum nothing would be read.
Bytes file_of(std::span<const std::uint8_t> body) {
  Bytes file{'R', 'W', 'M', 'A', 'P', 0, 0, 1};
  append(body.size(), 8, file);
  file.insert(file.end(), body.begin(), body.end());
  append(::crc32_z(0, file.data(), file.size()), 4, file);
  return file;
}

/// Drives a metre and sees something at every step.
void be_lost_in(MapSnapshot map) {
  Estimator estimator({.landmark_budget = 300});
  estimator.lose(std::move(map));
  OdometrySample odometry;
  odometry.interval = std::chrono::milliseconds(20);
  odometry.distance_m = 0.02;
  odometry.covariance = 1e-6 * Eigen::Matrix2d::Identity();
  std::vector<Sighting> seen(6);
  std::vector<Verdict> verdicts(seen.size());
  for (int tick = 1; tick <= 50; ++tick) {
    odometry.time = roomwise::Time(std::chrono::milliseconds(20 * tick));
    odometry.T_odom_robot.x_m = 0.02 * tick;
    (void)estimator.add_odometry(odometry);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const double across_m = 0.5 * static_cast<double>(i) - 1.0;
      const double ahead_m = 3.0 - odometry.T_odom_robot.x_m;
      seen[i].polar = {std::hypot(ahead_m, across_m), std::atan2(across_m, ahead_m),
                       1e-4 * Eigen::Matrix2d::Identity()};
    }
    if (estimator.timing(odometry.time) != FrameTiming::kReady) continue;
    estimator.process(odometry.time, seen, verdicts);
  }
  if (!estimator.estimate().covariance.allFinite()) __builtin_trap();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  MapSnapshot map;
  const std::span<const std::uint8_t> bytes(data, size);
  if (decode_map(bytes, map) == MapVerdict::kOk) __builtin_trap();  // 2^-32: not in our time
  const Bytes file = file_of(bytes);
  if (decode_map(file, map) != MapVerdict::kOk) {
    if (!map.empty()) __builtin_trap();
    return 0;
  }
  if (encode_map(map) != file) __builtin_trap();
  if (!map.empty()) be_lost_in(std::move(map));
  return 0;
}
