#include "services/create_driver/device/serial_port.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <termios.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace roomwise::create {
namespace {

constexpr int kWritePatience_ms = 20;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw std::runtime_error("serial port " + path.string() + ": " + what);
}

[[noreturn]] void fail_with_errno(const std::filesystem::path& path, const std::string& what) {
  fail(path, what + ": " + std::strerror(errno));
}

speed_t speed_of(int baud) {
  switch (baud) {
    case 19200:
      return B19200;
    case 57600:
      return B57600;
    case 115200:
      return B115200;
    default:
      throw std::runtime_error("no serial speed of " + std::to_string(baud) + " baud");
  }
}

FileDescriptor open_terminal(const std::filesystem::path& path) {
  FileDescriptor fd(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  if (fd.get() < 0) fail_with_errno(path, "cannot open");
  if (::isatty(fd.get()) == 0) fail(path, "is no serial port");
  return fd;
}

/// TIOCEXCL keeps others from opening it, but not root; the lock keeps out whoever asks for one.
void take_for_ourselves(int fd, const std::filesystem::path& path) {
  if (::flock(fd, LOCK_EX | LOCK_NB) != 0) fail(path, "in use by another process");
  if (::ioctl(fd, TIOCEXCL) != 0) fail_with_errno(path, "cannot be had alone");
}

void set_up_line(int fd, const std::filesystem::path& path, int baud) {
  termios line{};
  if (::tcgetattr(fd, &line) != 0) fail_with_errno(path, "cannot read its settings");
  ::cfmakeraw(&line);
  line.c_cflag |= static_cast<tcflag_t>(CLOCAL | CREAD);
  line.c_cflag &= ~static_cast<tcflag_t>(CRTSCTS | CSTOPB);
  line.c_iflag &= ~static_cast<tcflag_t>(IXON | IXOFF);
  line.c_cc[VMIN] = 1;  // with O_NONBLOCK this tells "nothing yet" from "hung up"
  line.c_cc[VTIME] = 0;
  ::cfsetspeed(&line, speed_of(baud));
  if (::tcsetattr(fd, TCSANOW, &line) != 0) fail_with_errno(path, "does not take its settings");
  ::tcflush(fd, TCIFLUSH);
}

bool becomes_writable(int fd) {
  pollfd writable{.fd = fd, .events = POLLOUT, .revents = 0};
  return ::poll(&writable, 1, kWritePatience_ms) > 0 && (writable.revents & POLLOUT) != 0;
}

}  // namespace

SerialPort::SerialPort(const std::filesystem::path& path, int baud) : fd_(open_terminal(path)) {
  take_for_ourselves(fd_.get(), path);
  set_up_line(fd_.get(), path, baud);
}

bool SerialPort::read(std::vector<std::uint8_t>& bytes) {
  std::array<std::uint8_t, 1024> chunk{};
  for (;;) {
    const ssize_t count = ::read(fd_.get(), chunk.data(), chunk.size());
    if (count > 0) {
      bytes.insert(bytes.end(), chunk.begin(), chunk.begin() + count);
    } else if (count < 0 && errno == EAGAIN) {
      return true;
    } else if (count == 0 || errno != EINTR) {
      return false;
    }
  }
}

bool SerialPort::write(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(fd_.get(), bytes.data(), bytes.size());
    if (count > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(count));
    } else if (count < 0 && errno == EAGAIN) {
      if (!becomes_writable(fd_.get())) return false;
    } else if (count == 0 || errno != EINTR) {
      return false;
    }
  }
  return true;
}

void SerialPort::set_wake_line(const std::string& line, bool is_low) {
  if (line == "none") return;
  const int bit = line == "rts" ? TIOCM_RTS : TIOCM_DTR;
  ::ioctl(fd_.get(), is_low ? TIOCMBIC : TIOCMBIS, &bit);  // a pseudo-terminal has none: no matter
}

}  // namespace roomwise::create
