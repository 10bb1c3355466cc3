#pragma once
#include <atomic>
#include <filesystem>
#include <functional>
#include <span>
#include <thread>

#include "common/time.h"

namespace roomwise {

/// Sits between a driver and a (simulated) Create's serial port, hands on every byte both ways, and
/// tells when bytes for the robot came by.
class SerialTap {
 public:
  using Heard = std::function<void(Time when, std::span<const std::uint8_t> to_robot)>;

  /// `robot`: the robot's port, waited for until it is there. `driver`: the port to be made for the
  /// driver. `heard` is called on a thread of the tap's own.
  SerialTap(std::filesystem::path robot, std::filesystem::path driver, Heard heard);
  SerialTap(const SerialTap&) = delete;
  SerialTap& operator=(const SerialTap&) = delete;
  ~SerialTap();

 private:
  void work();

  std::filesystem::path robot_;
  std::filesystem::path driver_;
  Heard heard_;
  std::atomic<bool> is_over_ = false;
  std::thread thread_;
};

}  // namespace roomwise
