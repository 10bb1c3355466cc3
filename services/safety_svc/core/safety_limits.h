#pragma once
#include "common/time.h"

/// What keeps people and robot safe whatever a parameter file says.
namespace roomwise::safety {

/// From the instant something is true to wheels that obey: 180 ms until silence is noticed, a tick,
/// and the driver's and guardian's own limits. Wheels may turn on this long at the old speed.
inline constexpr double kReaction_s = 0.30;
/// A Create brakes harder on any floor; on a wet one it slides.
inline constexpr double kBraking_mps2 = 1.0;
/// Soft enough not to lift the front or slip; 0.5 m/s is reached in a second.
inline constexpr double kAcceleration_mps2 = 0.5;
inline constexpr double kTurnAcceleration_radps2 = 4.0;
/// Where nothing is seen but the bumper will feel it: no faster than a bumper stops unhurt.
inline constexpr double kCreep_mps = 0.10;
/// Longest step of time that an acceleration is granted for: a late tick must not jerk.
inline constexpr double kStepMax_s = 0.04;

/// Five frames at 30 Hz: a camera, its service or the line between them has failed.
inline constexpr Duration kCameraAge = std::chrono::milliseconds(180);
/// A Create 1 reports its motion every 150 ms; one report may be lost.
inline constexpr Duration kOdometryAge = std::chrono::milliseconds(350);
/// Twelve of the robot's stream frames of 15 ms.
inline constexpr Duration kCreateStateAge = std::chrono::milliseconds(180);
/// Clocks of one machine agree; handling takes time, not the other way round.
inline constexpr Duration kFutureSlack = std::chrono::milliseconds(50);
/// What was measured or asked longer ago than this is a recording, not this robot.
inline constexpr Duration kStampAge = std::chrono::milliseconds(1000);
/// The wall clock may be slewed, not stepped.
inline constexpr Duration kClockStep = std::chrono::milliseconds(100);
/// How long a clock that was stepped, or a stamp from the future, is held against the sender.
inline constexpr Duration kDistrust = std::chrono::milliseconds(1000);

/// A request lives no longer than this, whatever it says: who asks must go on asking.
inline constexpr Duration kRequestLife = std::chrono::milliseconds(1000);
/// A held emergency stop is repeated at 2 Hz: silent for two of these it is held no more.
inline constexpr Duration kEstopHeld = std::chrono::milliseconds(1000);
/// Slower than this the robot counts as standing: two encoder ticks in 15 ms come to less.
inline constexpr double kStanding_mps = 0.06;
inline constexpr double kStanding_radps = 0.3;

/// Seen free this long ago somebody may have stepped in: a walker needs some 10 s to come from
/// behind everything the camera watches while it keeps that place. After that it is crept into: a
/// robot that stood for long must be able to go on.
inline constexpr Duration kFreeLife = std::chrono::seconds(10);
/// A low thing in the blind zone is remembered until it is seen to be gone, or this long.
inline constexpr Duration kClosedLife = std::chrono::seconds(60);
/// No Kinect measures nearer: what it does measure is not inside this circle.
inline constexpr double kNearestReading_m = 0.45;
/// More of a bearing's pixels than this without a reading: something too near, black or a mirror.
inline constexpr double kUnknownRatio = 0.5;

/// 10 degrees: a Create on a threshold of 2.5 cm leans 6, and close to a wall, where little floor
/// is left in view, the measured plane is off by as much.
inline constexpr double kTilt_rad = 0.175;
/// The camera sank or rose: the blind zone is not where it is taken to be. Measured: off by 0.10
/// close to a wall.
inline constexpr double kHeight_m = 0.15;

/// The way back is known where the robot itself came from, lately, and this near to its track.
inline constexpr double kTrackTolerance_m = 0.03;
inline constexpr double kReverse_m = 0.5;
inline constexpr Duration kTrackLife = std::chrono::seconds(20);

}  // namespace roomwise::safety
