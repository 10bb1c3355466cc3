#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "common/create/sensor_packets.h"

namespace roomwise::create {

/// Just enough of a Create 2 on a pseudo-terminal to take a driver through its start: it follows
/// Start, Safe, Full, Reset and Drive Direct, streams group 100 every 15 ms once asked, and writes
/// down what it was sent and when. No physics: the encoders count what the wheels were told.
class ScriptedRobot {
 public:
  using Clock = std::chrono::steady_clock;
  struct Wheels {
    int left_mmps = 0;
    int right_mmps = 0;
    friend bool operator==(const Wheels&, const Wheels&) = default;
  };

  /// Plugs in, under the name `link`.
  explicit ScriptedRobot(std::filesystem::path link);
  ScriptedRobot(const ScriptedRobot&) = delete;
  ScriptedRobot& operator=(const ScriptedRobot&) = delete;
  ~ScriptedRobot();

  OiMode mode() const;
  Wheels wheels() const;
  /// When the wheels last came to stand.
  Clock::time_point stopped_at() const;
  /// Commands received so far, by opcode.
  std::vector<std::uint8_t> opcodes() const;

  /// A safe-mode trip: stops, goes to Passive.
  void trip();
  /// Sends `text` on the line, between frames.
  void print(const std::string& text);

 private:
  void run();
  void read_commands();
  void obey(std::uint8_t opcode, const std::vector<std::uint8_t>& data);
  void enter(OiMode mode);
  void set_wheels(Wheels wheels);
  void send_frame();

  std::filesystem::path link_;
  int master_ = -1;
  int slave_ = -1;  // kept open: without it reading the master fails while no driver is there
  mutable std::mutex mutex_;
  std::vector<std::uint8_t> pending_;
  std::vector<std::uint8_t> opcodes_;
  std::string text_;
  OiMode mode_ = OiMode::kOff;
  bool is_streaming_ = false;
  Wheels wheels_;
  Clock::time_point stopped_at_{};
  double left_ticks_ = 65000.0;
  double right_ticks_ = 65000.0;
  std::atomic<bool> is_over_{false};
  std::thread thread_;
};

}  // namespace roomwise::create
