#pragma once
#include <cstdint>

namespace roomwise::create {

enum class Model : std::uint8_t { kCreate1 = 1, kCreate2 = 2 };

/// Commands of the Open Interface, by their first byte.
/// Source: iRobot, "Create Open Interface" (2006) and "Create 2 Open Interface Specification"
/// (2015).
enum class Opcode : std::uint8_t {
  kReset = 7,  ///< Create 2
  kStart = 128,
  kBaud = 129,
  kControl = 130,  ///< the same as kSafe
  kSafe = 131,
  kFull = 132,
  kPower = 133,
  kSpot = 134,
  kClean = 135,
  kMax = 136,  ///< Create 1: Demo, with one byte
  kDrive = 137,
  kMotors = 138,
  kLeds = 139,
  kSong = 140,
  kPlay = 141,
  kSensors = 142,
  kSeekDock = 143,
  kPwmMotors = 144,
  kDriveDirect = 145,  ///< right wheel first
  kDrivePwm = 146,     ///< Create 2
  kDigitalOutputs = 147,
  kStream = 148,
  kQueryList = 149,
  kPauseStream = 150,
  kStop = 173,  ///< Create 2
};

/// Operating modes as the manual numbers them in packet 35.
enum class OiMode : std::int8_t { kUnknown = -1, kOff = 0, kPassive = 1, kSafe = 2, kFull = 3 };

inline constexpr std::uint8_t kStreamHeader = 19;
inline constexpr int kSensorPeriod_us = 15'000;  ///< the robot reads its sensors this often
inline constexpr int kWheelSpeedMax_mmps = 500;

}  // namespace roomwise::create
