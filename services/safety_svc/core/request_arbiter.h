#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "services/safety_svc/core/instant.h"

namespace roomwise::safety {

/// How somebody wants the robot to move.
struct Request {
  double speed_mps = 0.0;        ///< along robot x, negative in reverse
  double turn_rate_radps = 0.0;  ///< counter-clockwise positive
};

/// What VEL_REQUEST says.
struct Asked {
  Request request;
  std::string_view source;
  int priority = 0;      ///< 0 to 100
  Duration valid_for{};  ///< from receipt on; cut at kRequestLife
  Time decided{};
};

enum class RequestResult : std::uint8_t {
  kHeard,
  kNotFinite,       ///< the source's older request is taken back too
  kOutOfRange,      ///< absurd speed, priority or life; the older one is taken back too
  kFromFuture,      ///< the same
  kOld,             ///< a recording; nothing changes
  kTooManySources,  ///< nothing changes
};

/// Holds the newest request of each source. Of those that live the highest priority is heard; of
/// equals the one whose source was heard first, so that two cannot take turns.
class RequestArbiter {
 public:
  struct Slot {
    std::string source;
    Request request;
    bool is_bad = false;  ///< its newest made no sense: it holds its place and asks for nothing
    int priority = 0;
    Duration received{};
    Duration until{};  ///< lives before this
  };
  static constexpr std::size_t kSources = 8;
  static constexpr std::size_t kSourceLetters = 32;

  RequestArbiter();

  [[nodiscard]] RequestResult hear(const Instant& now, const Asked& asked);

  /// The request to be decided on, or nullptr if none lives.
  const Slot* winner(const Instant& now) const;

 private:
  Slot* slot_of(const Instant& now, std::string_view source);

  std::array<Slot, kSources> slots_;
};

}  // namespace roomwise::safety
