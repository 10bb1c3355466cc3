#pragma once
#include <span>
#include <vector>

#include "services/ekf_svc/core/association.h"
#include "services/ekf_svc/core/constellation_closure.h"
#include "services/ekf_svc/core/ekf_params.h"
#include "services/ekf_svc/core/gate_monitor.h"
#include "services/ekf_svc/core/landmark_lifecycle.h"
#include "services/ekf_svc/core/local_association.h"
#include "services/ekf_svc/core/noise_monitor.h"
#include "services/ekf_svc/core/relocaliser.h"
#include "services/ekf_svc/core/sighting.h"
#include "services/ekf_svc/core/slam_filter.h"
#include "services/ekf_svc/core/tentative_landmarks.h"
#include "services/ekf_svc/core/twin_landmarks.h"

namespace roomwise::ekf {

/// What one frame did.
struct FrameResult {
  int seen = 0;  ///< sightings offered
  int matched = 0;
  int added = 0;
  int rejected = 0;           ///< unusable, ambiguous or refused by a gate
  int merged = 0;             ///< landmarks found to be others
  bool pose_widened = false;  ///< the gate was locking the filter out
};

/// Simultaneous localisation and mapping, frame by frame: decides which landmark each sighting is
/// of, corrects the filter by all of them at once, then adds what is new.
///
/// Known identity: the pair must pass a gate at d^2 = 25; see GateMonitor for what happens when it
/// does not. Unknown identity: see LocalAssociation for the frame, TentativeLandmarks for what is
/// new, ConstellationClosure and TwinLandmarks for what turns out to have been mapped before.
class Slam {
 public:
  explicit Slam(const EkfParams& params);

  Slam(const Slam&) = delete;
  Slam& operator=(const Slam&) = delete;

  /// Moves the robot. O(landmarks).
  void predict(const MotionIncrement& motion);

  /// Uses a frame taken at the present pose. `may_update` false: landmarks already mapped are not
  /// measured again, new ones are added. `verdicts` (as long as `sightings`) says what became of
  /// each. `scan`, if there is one, is of the same frame.
  FrameResult process(std::span<const Sighting> sightings, bool may_update,
                      std::span<Verdict> verdicts, const VirtualScan& scan = {});

  /// The robot is somewhere else: what the map promises is not there.
  bool says_lost() const { return lifecycle_.says_lost(); }
  /// Known landmarks contradict the pose, and widening it has not helped yet.
  bool is_doubtful() const { return widening_ratio_ > kWideningRatioTrusted; }
  /// Factor on the covariance of what is seen, from how well it fits.
  double noise_ratio() const { return noise_monitor_.ratio(); }

  const SlamFilter& filter() const { return filter_; }
  double travel_m() const { return travel_m_; }

  /// Forgets the map; the robot stands at the origin of a new one.
  void begin_anew();

  /// Goes on with a saved map, in which `local`, the present map of a few landmarks, was found to
  /// lie like this. False if the map is larger than the budget.
  [[nodiscard]] bool resume(const MapSnapshot& map, const MapSnapshot& local,
                            const Relocaliser::Place& place);

  /// Landmarks the last frame found to be others, by map_id.
  struct Merged {
    std::int64_t recent_id;
    std::int64_t old_id;
  };
  std::span<const Merged> merged() const { return merged_; }

 private:
  void free_calibrations();
  void free_ranges(std::span<const Sighting> sightings);
  void judge_all(std::span<const Sighting> sightings, std::span<Verdict> verdicts);
  Verdict judge(std::size_t i, const Sighting& sighting);
  void keep_best_pairs(std::span<Verdict> verdicts);
  bool learn_from_refusals(std::span<const Sighting> sightings, std::span<Verdict> verdicts);
  void widen_pose();
  void update(std::span<const Sighting> sightings, std::span<Verdict> verdicts);
  void update_batch(std::span<const Sighting> sightings, std::span<Verdict> verdicts);
  Residual softened_residual(std::size_t l, const BodyObservation& seen) const;
  Residual range_softened(std::size_t l, const BodyObservation& seen) const;
  void note_seen(std::span<const Sighting> sightings, std::span<const Verdict> verdicts);
  void merge_what_is_one();
  void merge(std::span<const LandmarkPair> pairs);
  void remove_what_is_gone(std::span<const Sighting> sightings, std::span<const Verdict> verdicts,
                           const VirtualScan& scan);
  void add_new(std::span<const Sighting> sightings, std::span<Verdict> verdicts);
  void replace_refused(std::span<const Sighting> sightings, std::span<Verdict> verdicts);
  Verdict add_known(const Sighting& sighting);
  Verdict add_unknown(std::size_t i, const Sighting& sighting);
  double sight_rad(const BodyObservation& seen) const;
  Landmark begun(const Sighting& sighting) const;
  BodyObservation body(const Sighting& sighting) const;

  static constexpr double kWideningRatioTrusted = 4.0;

  EkfParams params_;
  bool ranges_are_free_ = false;
  bool map_is_fixed_ = false;  // mode "localise", once in the map
  SlamFilter filter_;
  GateMonitor gate_monitor_;
  LocalAssociation local_;
  NoiseMonitor noise_monitor_;
  LandmarkLifecycle lifecycle_;
  TentativeLandmarks tentative_;
  ConstellationClosure closure_;
  TwinLandmarks twins_;
  std::vector<Merged> merged_;
  double travel_m_ = 0.0;                // way gone since the start
  double closure_due_travel_m_ = 0.0;    // when to look for closed loops again
  double widening_ratio_ = 1.0;          // doubles while widening does not help
  std::vector<Candidate> candidates_;    // per sighting of the frame
  std::vector<std::size_t> claimed_by_;  // per landmark: sighting that has it in this frame
  std::vector<std::size_t> batch_;       // sightings of one update
  std::vector<Residual> residuals_;      // and what they say
};

}  // namespace roomwise::ekf
