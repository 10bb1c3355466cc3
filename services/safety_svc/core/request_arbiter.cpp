#include "services/safety_svc/core/request_arbiter.h"

#include <algorithm>
#include <cmath>

#include "services/safety_svc/core/safety_limits.h"

namespace roomwise::safety {
namespace {

constexpr double kAbsurdSpeed_mps = 10.0;
constexpr double kAbsurdTurnRate_radps = 100.0;
constexpr int kPriorityMax = 100;

RequestResult judged(const Instant& now, const Asked& asked) {
  const auto& [speed_mps, turn_rate_radps] = asked.request;
  if (!std::isfinite(speed_mps) || !std::isfinite(turn_rate_radps)) {
    return RequestResult::kNotFinite;
  }
  if (std::abs(speed_mps) > kAbsurdSpeed_mps || std::abs(turn_rate_radps) > kAbsurdTurnRate_radps ||
      asked.priority < 0 || asked.priority > kPriorityMax || asked.valid_for <= Duration(0)) {
    return RequestResult::kOutOfRange;
  }
  if (asked.decided > now.wall + kFutureSlack) return RequestResult::kFromFuture;
  return RequestResult::kHeard;
}

}  // namespace

RequestArbiter::RequestArbiter() {
  for (Slot& slot : slots_) slot.source.reserve(kSourceLetters);
}

RequestResult RequestArbiter::hear(const Instant& now, const Asked& asked) {
  if (asked.decided < now.wall - kStampAge) return RequestResult::kOld;
  Slot* const slot = slot_of(now, asked.source);
  if (slot == nullptr) return RequestResult::kTooManySources;
  const RequestResult result = judged(now, asked);
  slot->is_bad = result != RequestResult::kHeard;
  slot->request = slot->is_bad ? Request{} : asked.request;
  slot->priority = std::clamp(asked.priority, 0, kPriorityMax);
  slot->received = now.steady;
  slot->until =
      now.steady + (slot->is_bad ? kRequestLife : std::min(asked.valid_for, kRequestLife));
  return result;
}

RequestArbiter::Slot* RequestArbiter::slot_of(const Instant& now, std::string_view source) {
  Slot* dead = nullptr;
  for (Slot& slot : slots_) {
    if (slot.source == source && slot.until > now.steady) return &slot;
    if (slot.until <= now.steady && dead == nullptr) dead = &slot;
  }
  if (dead == nullptr || source.size() > kSourceLetters) return nullptr;
  dead->source.assign(source);
  return dead;
}

const RequestArbiter::Slot* RequestArbiter::winner(const Instant& now) const {
  const Slot* best = nullptr;
  for (const Slot& slot : slots_) {
    if (slot.until <= now.steady) continue;
    if (best == nullptr || slot.priority > best->priority) best = &slot;
  }
  return best;
}

}  // namespace roomwise::safety
