#pragma once
#include <optional>

#include "services/safety_svc/core/body_state.h"
#include "services/safety_svc/core/camera_mount.h"
#include "services/safety_svc/core/estop_latch.h"
#include "services/safety_svc/core/input_watch.h"
#include "services/safety_svc/core/obstacle_memory.h"
#include "services/safety_svc/core/odometry_track.h"
#include "services/safety_svc/core/request_arbiter.h"
#include "services/safety_svc/core/safety_params.h"

namespace roomwise::safety {

/// The floor as one frame shows it.
struct FloorView {
  Time time{};  ///< of the frame
  FreeView free;
  bool is_plane_trusted = false;  ///< the plane below was measured in this frame
  Eigen::Vector3d floor_normal = Eigen::Vector3d::Zero();
  double floor_height_m = 0.0;
};

enum class InputResult : std::uint8_t {
  kUsed,
  kFromFuture,
  kOld,
  kOutOfOrder,
  kMalformed,  ///< numbers that cannot be; counts as not heard
  kNoPose,     ///< a view taken where odometry does not say where the robot was
  kNoMount,    ///< a view before the first frame said where the camera is
};

/// All that safety_svc knows. Fixed size: nothing is allocated after the constructor.
class World {
 public:
  explicit World(const SafetyParams& params);

  [[nodiscard]] InputResult hear_odometry(const Instant& now, const OdometrySample& sample);
  [[nodiscard]] InputResult hear_frame(const Instant& now, Time time, const CameraSetup& setup);
  [[nodiscard]] InputResult hear_view(const Instant& now, const FloorView& view);
  [[nodiscard]] InputResult hear_body(const Instant& now, Time time, const BodyState& body);
  /// To be called at every decision, before it.
  void tick(const Instant& now) { clock.tick(now); }

  InputWatch odometry;
  InputWatch frame;
  InputWatch view;
  InputWatch body_state;
  ClockWatch clock;
  RequestArbiter requests;
  EstopLatch estop;

  const BodyState& body() const { return body_; }
  const OdometryTrack& track() const { return track_; }
  const ObstacleMemory& memory() const { return memory_; }
  bool is_tilted() const { return is_tilted_; }
  /// Nobody asks for motion, the robot stands and nothing presses it: a stop may be reset.
  bool is_calm(const Instant& now) const;

 private:
  void feel(const Instant& now, const BodyState& body);
  double floor_seen_from_m() const;

  SafetyParams params_;
  BodyState body_;
  OdometryTrack track_;
  ObstacleMemory memory_;
  std::optional<CameraMount> mount_;
  bool is_tilted_ = false;
  // Since the odom frame began. That may be in full motion, when the wall clock is set.
  bool has_stood_ = false;
  bool has_moved_ = false;  // away from where it first stood
};

}  // namespace roomwise::safety
