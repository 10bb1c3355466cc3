#pragma once
#include <cstdint>
#include <vector>

#include "common/create/sensor_packets.h"
#include "common/time.h"
#include "services/create_driver/core/driver_event.h"
#include "services/create_driver/core/mode_reading.h"
#include "services/create_driver/core/oi_encoder.h"

namespace roomwise::create {

/// What the command in force would have the robot do.
enum class Wish : std::uint8_t { kStand, kForward, kBackOrTurn };

/// Gets the robot into the mode in which it obeys, and back there when it leaves it:
///
///   stop, Start -> stream -> Passive seen -> Safe (or Full) -> seen: may drive
///
/// - No stream after three starts: wakes the robot and begins again.
/// - It dropped to Passive (cliff, lifted wheel, charger): waits half a second and for lifted
/// wheels
///   and the charger plug; a robot on its home base stays there until it is asked to move.
/// - It boots: begins again when its boot text has ended. It reports a mode no manual lists (32
/// after
///   a trip on some): Reset, at most every 10 s, where the model has one.
/// - 20 ms after a mode command nothing else is sent: some robots miss what comes sooner.
///
/// All times are of the steady clock.
class ModeKeeper {
 public:
  /// `target`: kSafe or kFull. `ids`: the stream to ask for.
  ModeKeeper(Model model, OiMode target, std::vector<std::uint8_t> ids);

  /// Begins anew at the next step: the line was opened, or the robot may have been told otherwise.
  void begin(Duration now);

  /// A line of boot text came.
  void robot_boots(Duration now);

  /// A frame came; `packets`: the newest of everything.
  void see(Duration now, const SensorPackets& packets);

  /// Appends what is to be sent now.
  void step(Duration now, Wish wish, DriverCounts& counts, Bytes& bytes);

  bool may_drive() const { return phase_ == Phase::kDriving; }
  /// True while the robot is kept out of its mode by what is the matter with it.
  bool is_held() const { return phase_ == Phase::kResting; }
  /// True if the stream runs and a command of another kind may be sent.
  bool line_is_free(Duration now) const;
  bool pulls_wake_line(Duration now) const { return phase_ == Phase::kWaking && now < until_; }
  OiMode mode() const { return mode_; }
  int mode_drops() const { return mode_drops_; }

 private:
  enum class Phase : std::uint8_t {
    kStopping,  // about to send stop and Start
    kStarting,  // Start sent
    kAsking,    // stream asked for: a frame and Passive are to come
    kWaking,    // wake line pulled, or just waiting
    kBooting,   // boot text is coming
    kResting,   // in Passive, on purpose
    kEntering,  // Safe or Full sent
    kDriving,
  };
  void enter(Phase phase, Duration until);
  void start(Duration now, Bytes& bytes);
  void ask_for_stream(Duration now, Bytes& bytes);
  void look_for_passive(Duration now, DriverCounts& counts, Bytes& bytes);
  void rest(Duration now, Wish wish, Bytes& bytes);
  void check_entry(Duration now, DriverCounts& counts);
  void check_mode(Duration now, DriverCounts& counts, Bytes& bytes);
  void give_up_asking(Duration now, DriverCounts& counts, Bytes& bytes);
  void leave_unknown_mode(Duration now, DriverCounts& counts, Bytes& bytes);
  bool is_kept_from_driving(Wish wish) const;
  bool stream_is_silent(Duration now) const;

  Model model_;
  OiMode target_;
  std::vector<std::uint8_t> ids_;
  Phase phase_ = Phase::kStopping;
  Duration until_{};  // when phase_ is over, or has failed
  Duration asked_{};  // when the stream or the mode was asked for
  ModeReading reading_;
  OiMode mode_ = OiMode::kUnknown;
  SensorPackets packets_;
  Duration last_frame_{};
  bool has_frame_ = false;  // since the stream was asked for
  int starts_ = 0;          // in a row, without success
  int refusals_ = 0;        // in a row
  bool has_reset_ = false;
  Duration last_reset_{};
  int mode_drops_ = 0;
};

}  // namespace roomwise::create
