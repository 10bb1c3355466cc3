#pragma once
#include <cstdint>
#include <vector>

#include "common/create/encoder_odometry.h"
#include "common/create/oi_decoder.h"
#include "common/time.h"
#include "roomwise/create_state_t.hpp"
#include "roomwise/odometry_t.hpp"

namespace roomwise::simulator {

/// What the host of a Create 2 does in a drive that is recorded and not lived: starts the robot,
/// tells its wheels their speeds and reads its stream, without a clock and without a port. The
/// messages are those of create_driver, made by the same code from the same bytes.
class RecordingHost {
 public:
  RecordingHost();

  /// What the host says this often.
  static constexpr Duration kTurn{20'000};
  /// The robot obeys from this turn on.
  static constexpr int kFirstDrivingTurn = 15;

  /// Appends what is to be said in turn 0, 1, ...: first Start, Safe and a stream of everything, as
  /// far apart as the robot needs; from kFirstDrivingTurn on these rim speeds, at most 0.5 m/s.
  void talk(int turn, double left_mps, double right_mps, std::vector<std::uint8_t>& to_robot);

  /// Takes bytes that have arrived by `time`. A frame's messages are dated when the robot read its
  /// sensors: as long ago as the frame was on the line.
  void receive(Time time, const std::vector<std::uint8_t>& bytes);

  /// What the last receive() made, in order.
  const std::vector<create_state_t>& states() const { return states_; }
  const std::vector<odometry_t>& steps() const { return steps_; }

 private:
  void drive(double left_mps, double right_mps, std::vector<std::uint8_t>& to_robot);
  void use_frame(Time time, const create::StreamFrame& frame);

  create::OiDecoder decoder_;
  create::EncoderOdometry odometry_;
  create::SensorPackets packets_;
  double left_mps_ = 0.0;
  double right_mps_ = 0.0;
  std::int64_t state_seq_ = 0;
  std::int64_t step_seq_ = 0;
  std::vector<create_state_t> states_;
  std::vector<odometry_t> steps_;
};

}  // namespace roomwise::simulator
