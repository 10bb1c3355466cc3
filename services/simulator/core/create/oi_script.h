#pragma once
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "common/time.h"
#include "services/simulator/core/create/body_readings.h"
#include "services/simulator/core/create/command_reader.h"

namespace roomwise::simulator {

/// What a wait of the Create 1 waits for.
struct WaitInputs {
  Duration now{};
  double distance_mm = 0.0;  ///< ever travelled, forward positive
  double angle_deg = 0.0;    ///< ever turned, counter-clockwise positive
  OiMode mode = OiMode::kPassive;
};

/// Script and waits of the Create 1: up to 100 bytes that run as if the host sent them. While a
/// wait lasts, whatever the host sends is lost.
class OiScript {
 public:
  void store(const std::vector<std::uint8_t>& bytes);
  const std::vector<std::uint8_t>& stored() const { return stored_; }
  void play() { pending_.assign(stored_.begin(), stored_.end()); }
  void clear();

  /// Starts the wait of opcodes 155 to 158.
  void wait(const OiCommand& command, const WaitInputs& inputs);

  /// Ends the wait if what it waits for has come.
  void update(const WaitInputs& inputs, const BodyReadings& body);

  bool is_waiting() const { return wait_.has_value(); }

  /// The next byte of a script being played, unless it waits.
  std::optional<std::uint8_t> next_byte();

 private:
  struct Wait {
    OiCommand command;
    WaitInputs since;
  };
  std::vector<std::uint8_t> stored_;
  std::deque<std::uint8_t> pending_;
  std::optional<Wait> wait_;
};

}  // namespace roomwise::simulator
