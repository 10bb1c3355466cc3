#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "common/channels.h"
#include "tests/pilot_svc/support/coverage.h"

namespace roomwise {

/// One touch of the robot with the world, from TRUTH.
struct Contact {
  double at_s = 0.0;  ///< since the drive began
  double x_m = 0.0;   ///< world frame
  double y_m = 0.0;
  double speed_mps = 0.0;       ///< of the robot just before
  bool is_with_walker = false;  ///< nothing that stands still is near enough
};

/// What the truth says of a drive.
struct Verdict {
  double lasted_s = 0.0;
  double driven_m = 0.0;
  double covered_ratio = 0.0;  ///< of the floor the robot can get to
  double floor_m2 = 0.0;
  std::vector<Contact> contacts;
  int falls = 0;                 ///< times the wheels' midpoint came over a hole
  double nearest_hole_m = 0.0;   ///< of the body's rim; negative: over it
  double longest_stand_s = 0.0;  ///< without getting 0.1 m away, while the goal was in force
  double nearest_m = 0.0;        ///< of the body's rim to what stands still, while in watch
  double farthest_m = 0.0;
  int turnings = 0;  ///< turn rate changed sign from more than 0.3 rad/s within a second
  std::map<std::string, int> stops;  ///< by reason, while motion was asked for
  std::map<std::string, double> stopped_s;
  std::map<int, double> spent_s;  ///< by PILOT_STATE's state
  pilot_state_t last{};

  /// Contacts while the robot itself moved faster than `speed_mps`.
  int contacts_faster_than(double speed_mps) const;
};

std::ostream& operator<<(std::ostream& out, const Verdict& verdict);

/// Watches a drive through TRUTH, PILOT_STATE, SAFETY_STATE and VEL_CMD.
class TrialJudge {
 public:
  /// The scene's ground plan without those that walk is what stands still.
  explicit TrialJudge(const simulator::Scene& scene);

  void on_truth(const truth_t& truth);
  void on_pilot_state(const pilot_state_t& state);
  void on_safety_state(const safety_state_t& state);
  void on_command(const velocity_command_t& command);

  Verdict verdict() const;

 private:
  void watch_contact(const truth_t& truth);
  void watch_stand(const truth_t& truth);
  void watch_circle(const truth_t& truth);

  simulator::GroundPlan plan_;
  simulator::GroundPlan holes_;
  pilot::Coverage coverage_;
  std::vector<truth_t> recent_;  // oldest first, a few
  std::optional<std::int64_t> begun_;
  Eigen::Vector2d stands_at_m_{0.0, 0.0};
  std::int64_t stands_since_ = 0;
  bool is_over_hole_ = false;
  int state_ = 0;
  std::int64_t state_utime_ = 0;
  std::string stop_;
  std::int64_t safety_utime_ = 0;
  double turned_radps_ = 0.0;
  std::int64_t turned_utime_ = 0;
  Verdict so_far_;
};

}  // namespace roomwise
