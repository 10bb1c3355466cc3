// create_guardian: stops the robot when create_driver cannot. A Create keeps its last command for
// ever; this process shares the serial port, and when the driver is dead, frozen or hung it stops
// the wheels and puts the robot in Passive. Started by create_driver in a session of its own. It
// allocates nothing, takes no signal but SIGKILL and SIGSTOP, and ends when the driver is gone and
// the robot was told to stop.
#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <ctime>

#include "services/create_driver/core/oi_encoder.h"
#include "services/create_driver/guardian_line.h"

namespace {

using roomwise::create::kGuardianDriverFd;
using roomwise::create::kGuardianPortFd;
using roomwise::create::kGuardianSilence_ms;
using roomwise::create::kStopAndRest;

constexpr int kTimesToStop = 3;  // a byte may get lost on the line
constexpr int kBetweenStops_ms = 30;

void wait_ms(int time_ms) { ::poll(nullptr, 0, time_ms); }

void send_stop() {
  std::size_t sent = 0;
  for (int attempt = 0; sent < kStopAndRest.size() && attempt < 50; ++attempt) {
    const ssize_t count =
        ::write(kGuardianPortFd, kStopAndRest.data() + sent, kStopAndRest.size() - sent);
    if (count > 0) {
      sent += static_cast<std::size_t>(count);
    } else if (errno == EAGAIN) {
      wait_ms(2);
    } else {
      return;  // the port is gone
    }
  }
}

void stop_robot() {
  for (int i = 0; i < kTimesToStop; ++i) {
    send_stop();
    if (i + 1 < kTimesToStop) wait_ms(kBetweenStops_ms);
  }
}

/// Takes the beats that have come. False: the driver is gone.
bool take_beats() {
  char beats[64];
  const ssize_t count = ::read(kGuardianDriverFd, beats, sizeof beats);
  if (count < 0) return errno == EINTR || errno == EAGAIN;
  return count > 0 && ::write(kGuardianDriverFd, "a", 1) == 1;
}

void watch() {
  bool has_stopped = true;  // nothing was driven before the first beat
  for (;;) {
    pollfd beats{.fd = kGuardianDriverFd, .events = POLLIN, .revents = 0};
    const int ready = ::poll(&beats, 1, has_stopped ? -1 : kGuardianSilence_ms);
    if (ready > 0) {
      if (!take_beats()) return;
      has_stopped = false;
    } else if (ready == 0) {
      stop_robot();
      has_stopped = true;
    }
  }
}

}  // namespace

int main() {
  if (::fcntl(kGuardianPortFd, F_GETFD) < 0)
    return 2;  // started by hand: there is nothing to guard
  sigset_t all;
  ::sigfillset(&all);
  ::sigprocmask(SIG_BLOCK, &all, nullptr);
  ::close_range(kGuardianPortFd + 1, ~0U, 0);  // the driver's other files are not ours to keep open
  ::mlockall(MCL_CURRENT | MCL_FUTURE);        // never paged out; without the right to it, so be it
  if (::write(kGuardianDriverFd, "a", 1) == 1) watch();
  stop_robot();
  return 0;
}
