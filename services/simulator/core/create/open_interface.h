#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "common/time.h"
#include "services/simulator/core/create/body_readings.h"
#include "services/simulator/core/create/command_reader.h"
#include "services/simulator/core/create/drive_request.h"
#include "services/simulator/core/create/oi_odometer.h"
#include "services/simulator/core/create/oi_packets.h"
#include "services/simulator/core/create/oi_script.h"
#include "services/simulator/core/create/oi_song.h"
#include "services/simulator/core/create/open_interface_params.h"

namespace roomwise::simulator {

/// Bytes the robot sends in one go.
struct Transmission {
  std::vector<std::uint8_t> bytes;
  bool is_frame = false;  ///< 19, N, packets, checksum; otherwise a bare reply or the banner
};

/// The robot's firmware as its host sees it over the serial line: bytes in; bytes out and wheel
/// commands back. The Open Interface of a Create 1 or 2 with its modes, trips and habits:
///   - Off answers only Start; drive commands in Passive are ignored;
///   - the last drive command holds for ever: there is no time limit;
///   - in Safe a cliff ahead, a wheel drop or a charger stops the wheels and goes to Passive; a
///   bump
///     does not; in Full nothing does;
///   - a stream longer than its 15 ms slot at this baud rate is cut short by the next;
///   - five minutes in Passive without a mode command, and it sleeps: deaf until its power button.
///
/// A pure state machine: time and readings are handed in. Pacing to the baud rate is the caller's.
///
/// Source: iRobot Create 2 Open Interface specification (2015); iRobot Create Open Interface
/// (2006).
class OpenInterface {
 public:
  /// How often the sensors are read and a stream frame is due.
  static constexpr Duration kSensorPeriod{15'000};

  /// Throws std::invalid_argument on a choice OpenInterfaceParams does not name.
  explicit OpenInterface(const OpenInterfaceParams& params);

  /// Time goes on; to be called before receive() and sense() of that instant.
  void step(Duration now);

  /// One byte from the host.
  void receive(std::uint8_t byte);

  /// New readings, every kSensorPeriod: trips are judged and a stream frame is sent.
  void sense(const BodyReadings& body);

  /// What the motors are told to do.
  LeftRight<double> wheel_command_mps() const;

  /// What has been sent since the last call.
  std::vector<Transmission> take_transmissions();

  OiMode mode() const { return mode_; }
  int baud() const { return baud_; }
  /// What a stream frame can have sent before the next is due; the rest of it never leaves.
  std::size_t bytes_per_slot() const;
  double wheel_base_m() const { return wheel_base_m_; }

  /// Power cycles and resets so far: encoders start anew with each.
  int boots() const { return boots_; }

  /// The power is cut and returns: Off, the banner, deaf for a while.
  void reboot();
  /// As after a trip, without a cause the readings show.
  void drop_to_passive();
  /// Reports mode 32 from now on and ignores every mode command until it reboots.
  void lock();
  /// Wakes it.
  void press_power_button();

 private:
  bool is_deaf() const { return asleep_ || now_ < listens_from_; }
  void interpret(std::uint8_t byte);
  void obey(const OiCommand& command);
  void obey_mode(std::uint8_t opcode);
  void obey_drive(const OiCommand& command);
  void obey_sensing(const OiCommand& command);
  void obey_other(const OiCommand& command);
  void set_baud(std::uint8_t code);
  void enter(OiMode mode);
  void power_off();
  void trip_if_unsafe();
  void fall_asleep_if_idle();
  void run_script();
  WaitInputs wait_inputs() const;
  OiSnapshot snapshot() const;
  std::uint8_t mode_byte() const;
  bool moves_forward() const;
  void append_packets(std::uint8_t id, std::vector<std::uint8_t>& out);
  void reply(const std::vector<std::uint8_t>& ids);
  void send_stream_frame();

  OpenInterfaceParams params_;
  CreateModel model_;
  double wheel_base_m_;
  Duration now_{};
  OiMode mode_ = OiMode::kOff;
  int baud_;
  int boots_ = 0;
  bool asleep_ = false;
  bool locked_ = false;
  bool roams_ = false;  ///< cleaning, covering or seeking its dock by itself
  Duration listens_from_{};
  Duration awake_since_{};
  std::optional<Duration> banner_due_;
  CommandReader reader_;
  DriveRequest drive_;
  OiOdometer odometer_;
  OiScript script_;
  OiSong song_;
  std::vector<std::uint8_t> stream_;
  bool stream_paused_ = false;
  BodyReadings body_;
  std::vector<Transmission> transmissions_;
};

}  // namespace roomwise::simulator
