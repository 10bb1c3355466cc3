#pragma once
#include <optional>

#include "common/create/oi_decoder.h"
#include "common/time.h"
#include "services/create_driver/core/oi_encoder.h"

namespace roomwise::create {

/// Asks a Create 1 for packets 17 to 20 (among them distance and angle) every 150 ms, beside the
/// stream. The answer has no frame: it is taken for what stands between two frames, if that is just
/// as long. Asked at every frame instead, rounding would swallow all turns slower than 67 degrees a
/// second.
class BodyReadings {
 public:
  enum class Outcome : std::uint8_t { kNothing, kReading, kLost };

  /// Appends the question if it is time to ask.
  void ask_if_due(Duration now, Bytes& bytes);

  /// Looks for the answer before `frame`, received at `now`; kReading: its packets are in
  /// `packets`.
  Outcome look(Duration now, const StreamFrame& frame, SensorPackets& packets);

  /// Forgets a question asked: the line was broken.
  void restart() { is_waiting_ = false; }

 private:
  bool is_waiting_ = false;
  Duration asked_{};
};

}  // namespace roomwise::create
