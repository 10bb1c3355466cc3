#pragma once
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include "services/ekf_svc/core/joint_gate.h"
#include "services/ekf_svc/core/signature.h"

namespace roomwise::ekf {

/// One way to explain an observation.
struct Pairing {
  Residual residual;
  std::size_t target = 0;  ///< what it pairs with, used once at most
  SignatureDistance signature;
  double squared = 0.0;  ///< normalised innovation of this pair alone, signature included
};

/// Finds the most pairings of observations that are compatible all together (JCBB: branch and
/// bound). A set of pairings is compatible if its joint normalised innovation, signatures included,
/// is below the chi^2 quantile for its degrees of freedom; of sets with equally many pairings the
/// one with the smaller innovation wins.
///
/// Source: Neira, Tardos, IEEE TRA 2001; here observations with fewer pairings are decided first,
/// and the bound counts those which still have one.
class JointCompatibility {
 public:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  static constexpr std::size_t kObservationsMax = JointGate::kPairsMax;
  static constexpr std::size_t kPairingsPerObservation = 8;

  explicit JointCompatibility(const SlamFilter& filter);

  void clear() { count_ = 0; }
  std::size_t observations() const { return count_; }
  bool is_full() const { return count_ == kObservationsMax; }

  /// Begins an observation, numbered from 0. Throws std::logic_error when full.
  void begin_observation();
  /// Adds a pairing of the newest observation; its nearest kPairingsPerObservation are kept.
  void add(const Pairing& pairing);
  /// Takes pairings away, so that a search finds what else there is.
  void forbid(std::size_t observation, std::size_t target);

  struct Limits {
    double normal_quantile;  ///< of the joint gate
    int nodes;               ///< most pairings tried; then the best so far is the answer
  };
  struct Answer {
    std::size_t pairs = 0;
    double squared = 0.0;
    bool is_complete = true;                              ///< false: the limit of nodes was hit
    std::array<const Pairing*, kObservationsMax> chosen;  ///< per observation; nullptr: none
  };
  /// The answer's pairings live until the next clear().
  const Answer& search(const Limits& limits);

 private:
  struct Observation {
    std::array<Pairing, kPairingsPerObservation> pairings;  // nearest first
    std::size_t count = 0;
  };
  void decide(std::size_t depth);
  bool can_win(std::size_t depth) const;
  void keep_if_best();
  bool is_used(std::size_t target) const;

  std::vector<Observation> observations_;
  std::size_t count_ = 0;

  Limits limits_{};
  int nodes_ = 0;
  double squared_ = 0.0;  // of the pairings on the stack
  int degrees_of_freedom_ = 0;
  JointGate gate_;
  std::array<std::size_t, kObservationsMax> order_{};  // of deciding
  std::array<std::size_t, kObservationsMax + 1>
      hopeful_{};                                         // observations with pairings, from depth
  std::array<const Pairing*, kObservationsMax> stack_{};  // per observation
  Answer best_;
};

}  // namespace roomwise::ekf
