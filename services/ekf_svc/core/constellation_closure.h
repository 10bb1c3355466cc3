#pragma once
#include <array>
#include <span>
#include <vector>

#include "services/ekf_svc/core/joint_compatibility.h"
#include "services/ekf_svc/core/landmark_pair.h"

namespace roomwise::ekf {

/// Closes loops, late and for many landmarks at once: the landmarks begun lately (A) are compared,
/// as one figure, with those not seen for a long way (B). A pair says 0 = R^T (f_a - f_b).
///
/// Accepted only if at least kPairsMin pairs and 60 % of A are jointly compatible (95 %), the
/// search was complete, and the best rival that avoids every chosen pair has two pairs less. Then
/// each pair must still fit given all the others, and no other landmark may fit in place of one of
/// its two.
class ConstellationClosure {
 public:
  explicit ConstellationClosure(const SlamFilter& filter);

  /// The pairs to be merged now, after `travel_m` of way; none: empty. The answer lives until the
  /// next call.
  std::span<const LandmarkPair> find(double travel_m);

  static constexpr double kSigma_m = 0.02;  ///< how well a landmark is found again
  static constexpr std::size_t kPairsMin = 5;

 private:
  void collect(double travel_m);
  void offer_pairings();
  bool has_rival(std::size_t pairs);
  void keep_sure_pairs();
  bool is_sure(std::size_t pair);

  const SlamFilter* filter_;
  std::vector<std::size_t> recent_;  // A
  std::vector<std::size_t> old_;     // B
  JointCompatibility joint_;
  JointGate gate_;
  std::vector<Pairing> accepted_;
  std::vector<LandmarkPair> pairs_;
};

/// What makes a pair of landmarks the same thing to the eye: kind, colour, unknown identity, and
/// the old one was never seen after the recent one was begun.
bool may_be_one(const Landmark& recent, const Landmark& old);

}  // namespace roomwise::ekf
