#pragma once
#include <array>
#include <optional>
#include <variant>

#include "services/pilot_svc/core/circle.h"
#include "services/pilot_svc/core/glance.h"
#include "services/pilot_svc/core/go_to.h"
#include "services/pilot_svc/core/recovery.h"
#include "services/pilot_svc/core/wander.h"

namespace roomwise::pilot {

/// What ODOMETRY says.
struct OdometrySample {
  Time time{};
  Pose2 T_odom_robot;
  int reset_counter = 0;
};

enum class InputResult : std::uint8_t {
  kUsed,
  kNotFinite,    ///< or no view at all; nothing changed
  kOutOfOrder,   ///< not newer than the last; nothing changed
  kNoOdometry,   ///< no odometry of the same time; nothing changed
  kStartedAnew,  ///< used; a new odom frame or clock: all that was remembered is forgotten
};

/// What safety_svc holds the robot for.
enum class Hold : std::uint8_t {
  kNone,
  kTouched,  ///< bump, cliff, virtual wall: it can free itself
  kHeld,     ///< emergency stop, a missing input, the robot's mode: only waiting helps
};

/// What PILOT_STATE says.
struct Report {
  Behaviour behaviour = Behaviour::kStop;
  State state = State::kIdle;
  Failure failure = Failure::kNone;
  const char* waits_for = "";  ///< in words; empty: for nothing
  Progress progress{};
  double driven_m = 0.0;
  double bearing_rad = 0.0;
  int recoveries = 0;
};

/// The behaviours on one robot. Time is the inputs' own: call tick() every 50 ms of it.
///
/// Denies by default: what a behaviour needs and is missing, stale or not finite means zero motion
/// and kWaiting; after `wait_max_s` kFailed. Same calls, same answers; nothing is allocated after
/// construction.
class Pilot {
 public:
  explicit Pilot(const PilotParams& params);

  /// Takes up a newer goal. An unsound one fails at once.
  void set_goal(const Goal& goal);

  [[nodiscard]] InputResult add_odometry(const OdometrySample& sample);
  /// A frame taken at `time`; where the robot was then comes from the odometry of the last second.
  [[nodiscard]] InputResult add_view(Time time, const FreeView& view);
  [[nodiscard]] InputResult add_pose(Time time, const Pose2& T_map_robot, bool is_tracking);
  void set_hold(Hold hold) { hold_ = hold; }
  /// safety_svc does not let it go there (robot frame of now): ways through that place are not
  /// taken for a while, or it looks there first.
  void add_refusal(const Eigen::Vector2d& p_robot_m);

  Motion tick(Time now);
  const Report& report() const { return report_; }

 private:
  using BehaviourState = std::variant<std::monostate, Wander, Circle, GoTo>;
  static constexpr std::size_t kTrack = 128;

  const OdometrySample* odometry_at(Time time) const;
  void start_anew();
  void take_up_behaviour();
  Failure missing(Time now) const;
  Motion wait(Time now, Failure why);
  Motion recover(Time now);
  Motion drive(Time now);
  static Motion turned_first(const Step& step);
  Step behave(const Surroundings& around);
  void end(State state, Failure failure);
  void update_progress(Time now);

  PilotParams params_;
  ObstacleMemory memory_;
  VisitMemory visits_;
  std::vector<Eigen::Vector2d> obstacles_robot_m_;
  std::array<OdometrySample, kTrack> track_{};  // a ring
  std::size_t track_count_ = 0;                 // samples ever taken
  std::optional<Time> viewed_;
  std::optional<Time> posed_;
  bool pose_is_tracking_ = false;
  Pose2 T_odom_map_;
  Hold hold_ = Hold::kNone;

  Goal goal_;
  std::optional<Time> goal_since_;  // when first stepped
  std::optional<Time> refused_;
  std::optional<Time> waits_since_;
  BehaviourState behaviour_;
  StuckWatch stuck_;
  Recovery recovery_;
  Glance glance_;
  Report report_;
};

}  // namespace roomwise::pilot
