#include "services/ekf_svc/core/joint_compatibility.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "services/ekf_svc/core/chi_square.h"

namespace roomwise::ekf {

JointCompatibility::JointCompatibility(const SlamFilter& filter)
    : observations_(kObservationsMax), gate_(filter) {}

void JointCompatibility::begin_observation() {
  if (is_full()) throw std::logic_error("JointCompatibility: too many observations");
  observations_[count_++].count = 0;
}

void JointCompatibility::add(const Pairing& pairing) {
  Observation& observation = observations_.at(count_ - 1);
  auto& pairings = observation.pairings;
  const auto end = pairings.begin() + static_cast<std::ptrdiff_t>(observation.count);
  const auto place = std::upper_bound(
      pairings.begin(), end, pairing.squared,
      [](double squared, const Pairing& other) { return squared < other.squared; });
  if (place == pairings.end()) return;
  if (observation.count < kPairingsPerObservation) ++observation.count;
  const auto last = pairings.begin() + static_cast<std::ptrdiff_t>(observation.count) - 1;
  std::move_backward(place, last, last + 1);
  *place = pairing;
}

void JointCompatibility::forbid(std::size_t observation, std::size_t target) {
  Observation& from = observations_.at(observation);
  const auto end = from.pairings.begin() + static_cast<std::ptrdiff_t>(from.count);
  const auto kept = std::remove_if(from.pairings.begin(), end,
                                   [=](const Pairing& p) { return p.target == target; });
  from.count = static_cast<std::size_t>(kept - from.pairings.begin());
}

const JointCompatibility::Answer& JointCompatibility::search(const Limits& limits) {
  limits_ = limits;
  nodes_ = 0;
  squared_ = 0.0;
  degrees_of_freedom_ = 0;
  gate_.clear();
  stack_.fill(nullptr);
  best_ = {};
  best_.chosen.fill(nullptr);
  const auto end = order_.begin() + static_cast<std::ptrdiff_t>(count_);
  std::iota(order_.begin(), end, std::size_t{0});
  std::sort(order_.begin(), end, [this](std::size_t a, std::size_t b) {
    const std::size_t count_a = observations_[a].count, count_b = observations_[b].count;
    return count_a != count_b ? count_a < count_b : a < b;
  });
  hopeful_[count_] = 0;
  for (std::size_t depth = count_; depth-- > 0;) {
    hopeful_[depth] = hopeful_[depth + 1] + (observations_[order_[depth]].count > 0 ? 1 : 0);
  }
  decide(0);
  return best_;
}

void JointCompatibility::decide(std::size_t depth) {
  if (depth == count_) return keep_if_best();
  const std::size_t observation = order_[depth];
  const Observation& choices = observations_[observation];
  for (std::size_t k = 0; k < choices.count; ++k) {
    const Pairing& pairing = choices.pairings[k];
    if (is_used(pairing.target) || !can_win(depth)) continue;
    if (++nodes_ > limits_.nodes) {
      best_.is_complete = false;
      return;
    }
    const double added = gate_.push(pairing.residual);
    if (added == std::numeric_limits<double>::infinity()) continue;
    const double cost = added + pairing.signature.squared;
    const double squared_before = squared_;
    const int freedom = 2 + pairing.signature.degrees_of_freedom;
    if (squared_ + cost <
        chi_square_quantile(degrees_of_freedom_ + freedom, limits_.normal_quantile)) {
      squared_ += cost;
      degrees_of_freedom_ += freedom;
      stack_[observation] = &pairing;
      decide(depth + 1);
      stack_[observation] = nullptr;
      squared_ = squared_before;
      degrees_of_freedom_ -= freedom;
    }
    gate_.pop();
    if (!best_.is_complete) return;
  }
  // This observation is of nothing known: its pairings are no hope any more.
  const std::size_t hope = hopeful_[depth];
  hopeful_[depth] = hopeful_[depth + 1];
  if (can_win(depth)) decide(depth + 1);
  hopeful_[depth] = hope;
}

bool JointCompatibility::can_win(std::size_t depth) const {
  const std::size_t reachable = gate_.pairs() + hopeful_[depth];
  return reachable > best_.pairs || (reachable == best_.pairs && squared_ < best_.squared);
}

void JointCompatibility::keep_if_best() {
  const std::size_t pairs = gate_.pairs();
  const bool is_better = pairs > best_.pairs || (pairs == best_.pairs && squared_ < best_.squared);
  if (!is_better) return;
  best_.pairs = pairs;
  best_.squared = squared_;
  best_.chosen = stack_;
}

bool JointCompatibility::is_used(std::size_t target) const {
  return std::any_of(stack_.begin(), stack_.begin() + static_cast<std::ptrdiff_t>(count_),
                     [=](const Pairing* p) { return p != nullptr && p->target == target; });
}

}  // namespace roomwise::ekf
