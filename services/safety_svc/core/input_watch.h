#pragma once
#include <cstdint>
#include <optional>

#include "services/safety_svc/core/instant.h"
#include "services/safety_svc/core/safety_limits.h"

namespace roomwise::safety {

enum class StampResult : std::uint8_t {
  kFresh,
  kFromFuture,  ///< not to be used; the input is distrusted for a while
  kOld,         ///< a recording: not to be used
  kOutOfOrder,  ///< not newer than the last: not to be used
};

/// One stream of measurements: when the last usable one came, by the receiver's own steady clock.
/// Silence, and stamps that cannot be true, both mean that nothing is known.
class InputWatch {
 public:
  /// A measurement of `measured` came at `now`. Only a fresh one counts as heard.
  [[nodiscard]] StampResult hear(const Instant& now, Time measured);

  bool is_fresh(const Instant& now, Duration age_max) const;
  bool is_distrusted(const Instant& now) const { return now.steady < distrusted_until_; }
  /// Since the last usable measurement [s]; -1: there was none.
  double age_s(const Instant& now) const;

 private:
  std::optional<Duration> received_;
  Time newest_ = Time::min();
  Duration distrusted_until_ = Duration::min();
};

/// Notices that the wall clock was set: it then no longer keeps step with the steady one.
class ClockWatch {
 public:
  void tick(const Instant& now);
  bool is_distrusted(const Instant& now) const { return now.steady < distrusted_until_; }

 private:
  std::optional<Instant> last_;
  Duration distrusted_until_ = Duration::min();
};

}  // namespace roomwise::safety
