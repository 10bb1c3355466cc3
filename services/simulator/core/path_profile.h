#pragma once

namespace roomwise::simulator {

/// A stretch of way (or an angle) covered with bounded speed and acceleration: speeding up,
/// holding, slowing down. Units are the caller's; metres or radians.
class SpeedProfile {
 public:
  struct Bounds {
    double speed;
    double acceleration;
  };
  struct Moment {
    double way;
    double speed;
  };

  /// Over `way` >= 0, from speed `first` to speed `last` (both within [0, bounds.speed]). The way
  /// must be long enough for the change from first to last.
  SpeedProfile(double way, double first, double last, Bounds bounds);

  double way() const { return way_; }
  double duration_s() const { return up_s_ + hold_s_ + down_s_; }
  double up_s() const { return up_s_; }  ///< end of speeding up
  double down_from_s() const { return up_s_ + hold_s_; }

  /// At `t_s` after its start; held at its ends outside [0, duration].
  Moment at(double t_s) const;

 private:
  double way_;
  double first_;
  double last_;
  double acceleration_;
  double peak_ = 0.0;
  double up_s_ = 0.0;
  double hold_s_ = 0.0;
  double down_s_ = 0.0;
};

}  // namespace roomwise::simulator
