#pragma once
#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace roomwise::simulator {

/// A serial port as a host has it open.
class HostPort {
 public:
  explicit HostPort(const std::filesystem::path& path, speed_t speed = B115200)
      : file_(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK)) {
    if (file_ < 0) throw std::runtime_error("cannot open " + path.string());
    set_speed(speed);
    ::tcflush(file_, TCIOFLUSH);
  }
  HostPort(const HostPort&) = delete;
  HostPort& operator=(const HostPort&) = delete;
  ~HostPort() { ::close(file_); }

  void set_speed(speed_t speed) const {
    termios settings{};
    ::tcgetattr(file_, &settings);
    ::cfmakeraw(&settings);
    ::cfsetspeed(&settings, speed);
    ::tcsetattr(file_, TCSANOW, &settings);
  }

  bool write(const std::vector<std::uint8_t>& bytes) const {
    return ::write(file_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
  }

  /// What is there now.
  std::vector<std::uint8_t> read() const {
    std::vector<std::uint8_t> bytes(100'000);
    const ssize_t got = ::read(file_, bytes.data(), bytes.size());
    bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return bytes;
  }

  /// What comes until `enough(all of it)`, or `patience` is over.
  template <class Enough>
  std::vector<std::uint8_t> read_until(
      Enough enough, std::chrono::milliseconds patience = std::chrono::seconds(20)) const {
    const auto end = std::chrono::steady_clock::now() + patience;
    std::vector<std::uint8_t> all;
    while (!enough(all) && std::chrono::steady_clock::now() < end && !has_hung_up()) {
      wait(std::chrono::milliseconds(10));
      const auto more = read();
      all.insert(all.end(), more.begin(), more.end());
    }
    return all;
  }

  bool has_hung_up() const { return (wait({}) & POLLHUP) != 0; }

 private:
  short wait(std::chrono::milliseconds patience) const {
    pollfd waiting{.fd = file_, .events = POLLIN, .revents = 0};
    ::poll(&waiting, 1, static_cast<int>(patience.count()));
    return waiting.revents;
  }

  int file_;
};

}  // namespace roomwise::simulator
