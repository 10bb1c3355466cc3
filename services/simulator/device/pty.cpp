#include "services/simulator/device/pty.h"

#include <fcntl.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

namespace roomwise::simulator {
namespace {

[[noreturn]] void fail(const std::filesystem::path& link, const std::string& what) {
  throw std::runtime_error("serial port " + link.string() + ": " + what + ": " +
                           std::generic_category().message(errno));
}

constexpr std::pair<speed_t, int> kSpeeds[] = {{B300, 300},       {B600, 600},      {B1200, 1200},
                                               {B2400, 2400},     {B4800, 4800},    {B9600, 9600},
                                               {B19200, 19200},   {B38400, 38400},  {B57600, 57600},
                                               {B115200, 115200}, {B230400, 230400}};

void close(int& descriptor) {
  if (descriptor >= 0) ::close(descriptor);
  descriptor = -1;
}

}  // namespace

Pty::Pty(std::filesystem::path link) : link_(std::move(link)) { reopen(); }

Pty::~Pty() { hang_up(); }

void Pty::reopen() {
  hang_up();
  try {
    open();
    make_link();
  } catch (...) {
    hang_up();
    throw;
  }
}

void Pty::open() {
  if (::openpty(&master_, &slave_, nullptr, nullptr, nullptr) != 0) fail(link_, "no terminal");
  char name[128];
  if (::ttyname_r(slave_, name, sizeof name) != 0) fail(link_, "terminal without a name");
  slave_path_ = name;
  termios raw{};
  if (::tcgetattr(slave_, &raw) != 0) fail(link_, "cannot read the terminal's settings");
  ::cfmakeraw(&raw);
  if (::tcsetattr(slave_, TCSANOW, &raw) != 0) fail(link_, "cannot make the terminal raw");
  for (const int descriptor : {master_, slave_}) {
    ::fcntl(descriptor, F_SETFD, FD_CLOEXEC);
    ::fcntl(descriptor, F_SETFL, ::fcntl(descriptor, F_GETFL) | O_NONBLOCK);
  }
}

/// Replaces the link in one step: a host never finds half of it.
void Pty::make_link() const {
  const std::filesystem::path fresh = link_.string() + ".new";
  std::error_code ignored;
  if (link_.has_parent_path()) std::filesystem::create_directories(link_.parent_path(), ignored);
  if (std::filesystem::exists(std::filesystem::symlink_status(link_, ignored)) &&
      !std::filesystem::is_symlink(link_, ignored)) {
    throw std::runtime_error("serial port " + link_.string() + ": there is a file of that name");
  }
  std::filesystem::remove(fresh, ignored);
  if (::symlink(slave_path_.c_str(), fresh.c_str()) != 0) fail(link_, "cannot make the link");
  if (::rename(fresh.c_str(), link_.c_str()) != 0) fail(link_, "cannot name the link");
}

void Pty::remove_link() const {
  std::error_code error;
  if (std::filesystem::read_symlink(link_, error) == slave_path_ && !error) {
    std::filesystem::remove(link_, error);
  }
}

void Pty::hang_up() {
  if (!slave_path_.empty()) remove_link();
  slave_path_.clear();
  close(slave_);
  close(master_);
}

void Pty::read(std::size_t most, std::vector<std::uint8_t>& bytes) {
  const std::size_t before = bytes.size();
  bytes.resize(before + most);
  const ssize_t got = is_open() && most > 0 ? ::read(master_, bytes.data() + before, most) : 0;
  bytes.resize(before + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
}

std::size_t Pty::write(std::span<const std::uint8_t> bytes) {
  if (!is_open() || bytes.empty()) return bytes.size();
  const ssize_t put = ::write(master_, bytes.data(), bytes.size());
  return bytes.size() - static_cast<std::size_t>(std::max<ssize_t>(put, 0));
}

int Pty::host_baud() const {
  termios settings{};
  if (!is_open() || ::tcgetattr(master_, &settings) != 0) return 0;
  const speed_t speed = ::cfgetospeed(&settings);
  for (const auto& [code, baud] : kSpeeds) {
    if (code == speed) return baud;
  }
  return 0;
}

}  // namespace roomwise::simulator
