#pragma once
#include <span>
#include <vector>

#include "services/ekf_svc/core/association.h"
#include "services/ekf_svc/core/joint_compatibility.h"

namespace roomwise::ekf {

/// Which landmarks the sightings of unknown identity in a frame are of, decided for all together.
///
/// Only local landmarks are asked: those seen in the last kLocalTravel_m of way, and those whose
/// place relative to the robot is known far better than they stand apart. The rest are left to
/// ConstellationClosure: after a long way round, one frame of a narrow view cannot tell one doorway
/// from the next.
///
/// An outline must be off in range by about as much as it was before (outline.h). A sighting
/// joins the jointly compatible set (99 %), or is of something new if no local landmark
/// is nearer than d^2 = 25 or if all it could be are seen beside it in the same frame, or else
/// ambiguous (Bailey et al., IROS 2006).
class LocalAssociation {
 public:
  explicit LocalAssociation(const SlamFilter& filter);

  /// Begins a frame seen after `travel_m` of way.
  void begin(double travel_m);

  /// Offers sighting number `sighting` of the frame. False if it cannot be taken in: too many have
  /// candidates already.
  bool offer(std::size_t sighting, const Sighting& what, const BodyObservation& seen);

  /// Decides, and writes verdicts and candidates of those offered.
  void decide(std::span<Verdict> verdicts, std::span<Candidate> candidates);

  static constexpr double kLocalTravel_m = 8.0;
  static constexpr double kNewLandmarkSq = 25.0;

 private:
  struct LocalLandmark {
    std::size_t index;
    Eigen::Vector2d p_map_m;
    double spread_m2;  // above the largest eigenvalue of S without the sighting's noise
    bool is_seen_lately;
  };
  struct Offer {
    std::size_t sighting;
    double nearest_sq;
    bool has_candidates;
    std::size_t first_candidate;  // in candidates_
  };

  bool are_all_taken(std::size_t offer) const;
  bool is_well_known(const LocalLandmark& local, double variance_m2, double noise_m2) const;

  const SlamFilter* filter_;
  double travel_m_ = 0.0;
  std::vector<LocalLandmark> locals_;
  std::vector<Offer> offers_;
  std::vector<std::size_t> candidates_;  // landmark numbers, offer by offer
  std::vector<bool> is_taken_;           // by landmark number, in this frame
  JointCompatibility joint_;
};

}  // namespace roomwise::ekf
