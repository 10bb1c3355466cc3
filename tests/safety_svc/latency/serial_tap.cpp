#include "tests/safety_svc/latency/serial_tap.h"

#include <poll.h>

#include <chrono>
#include <stdexcept>
#include <utility>
#include <vector>

#include "services/create_driver/device/serial_port.h"
#include "services/simulator/device/pty.h"

namespace roomwise {
namespace {

using std::chrono::microseconds;

constexpr int kBaud = 115200;  // of a Create 2
constexpr std::size_t kMost = 4096;
constexpr microseconds kLook{100};  // how often the driver's side is looked at

Time wall_now() { return std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now()); }

}  // namespace

SerialTap::SerialTap(std::filesystem::path robot, std::filesystem::path driver, Heard heard)
    : robot_(std::move(robot)),
      driver_(std::move(driver)),
      heard_(std::move(heard)),
      thread_([this] { work(); }) {}

SerialTap::~SerialTap() {
  is_over_ = true;
  thread_.join();
}

void SerialTap::work() {
  while (!is_over_ && !std::filesystem::exists(robot_)) std::this_thread::sleep_for(kLook);
  if (is_over_) return;
  create::SerialPort robot(robot_, kBaud);
  simulator::Pty driver(driver_);
  std::vector<std::uint8_t> bytes;
  pollfd wanted{.fd = robot.fd(), .events = POLLIN, .revents = 0};
  const timespec wait{.tv_sec = 0, .tv_nsec = std::chrono::nanoseconds(kLook).count()};
  while (!is_over_) {
    ::ppoll(&wanted, 1, &wait, nullptr);
    bytes.clear();
    if (!robot.read(bytes)) return;
    if (driver.write(bytes) > 0) return;  // the driver no longer reads
    bytes.clear();
    driver.read(kMost, bytes);
    if (bytes.empty()) continue;
    heard_(wall_now(), bytes);
    if (!robot.write(bytes)) return;
  }
}

}  // namespace roomwise
