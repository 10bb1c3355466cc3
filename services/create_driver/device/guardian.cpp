#include "services/create_driver/device/guardian.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>

#include "services/create_driver/guardian_line.h"

namespace roomwise::create {
namespace {

constexpr int kFirstAnswerPatience_ms = 1000;
constexpr int kMostUnanswered = 15;  // beats, 20 ms apart
constexpr int kEndPatience_ms = 500;

/// A copy at a number that dup2 onto the guardian's numbers cannot hit.
FileDescriptor out_of_the_way(int fd) {
  FileDescriptor copy(::fcntl(fd, F_DUPFD_CLOEXEC, 10));
  if (copy.get() < 0) throw std::runtime_error("create_guardian: no file descriptor left");
  return copy;
}

/// What posix_spawn is to do before the guardian's main.
class SpawnSetup {
 public:
  SpawnSetup(int driver_fd, int port_fd) {
    ::posix_spawn_file_actions_init(&actions);
    for (const int stdio : {0, 1, 2}) {
      ::posix_spawn_file_actions_addopen(&actions, stdio, "/dev/null", O_RDWR, 0);
    }
    ::posix_spawn_file_actions_adddup2(&actions, driver_fd, kGuardianDriverFd);
    ::posix_spawn_file_actions_adddup2(&actions, port_fd, kGuardianPortFd);
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
  }
  SpawnSetup(const SpawnSetup&) = delete;
  SpawnSetup& operator=(const SpawnSetup&) = delete;
  ~SpawnSetup() {
    ::posix_spawn_file_actions_destroy(&actions);
    ::posix_spawnattr_destroy(&attributes);
  }
  posix_spawn_file_actions_t actions{};
  posix_spawnattr_t attributes{};
};

}  // namespace

std::filesystem::path guardian_program() {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / "create_guardian";
}

Guardian::Guardian(const std::filesystem::path& program, int port_fd) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw std::runtime_error(std::string("create_guardian: no socket: ") + std::strerror(errno));
  }
  line_ = FileDescriptor(ends[0]);
  const FileDescriptor child_end(ends[1]);
  start(program, child_end.get(), port_fd);
  if (!answers_within(kFirstAnswerPatience_ms)) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    throw std::runtime_error("create_guardian does not answer");
  }
}

void Guardian::start(const std::filesystem::path& program, int child_end, int port_fd) {
  const FileDescriptor driver_copy = out_of_the_way(child_end);
  const FileDescriptor port_copy = out_of_the_way(port_fd);
  const SpawnSetup setup(driver_copy.get(), port_copy.get());
  std::string name = program.string();
  std::array<char*, 2> arguments{name.data(), nullptr};
  std::array<char*, 1> environment{nullptr};
  const int error = ::posix_spawn(&pid_, name.c_str(), &setup.actions, &setup.attributes,
                                  arguments.data(), environment.data());
  if (error != 0) throw std::runtime_error("cannot start " + name + ": " + std::strerror(error));
}

bool Guardian::answers_within(int patience_ms) const {
  pollfd readable{.fd = line_.get(), .events = POLLIN, .revents = 0};
  if (::poll(&readable, 1, patience_ms) <= 0) return false;
  std::array<char, 64> answers{};
  return ::recv(line_.get(), answers.data(), answers.size(), MSG_DONTWAIT) > 0;
}

bool Guardian::beat() {
  constexpr char kBeat = 'b';
  if (::send(line_.get(), &kBeat, 1, MSG_DONTWAIT | MSG_NOSIGNAL) != 1) return false;
  unanswered_ = answers_within(0) ? 0 : unanswered_ + 1;
  return unanswered_ < kMostUnanswered;
}

bool Guardian::has_ended() const { return ::waitpid(pid_, nullptr, WNOHANG) != 0; }

Guardian::~Guardian() {
  ::shutdown(line_.get(), SHUT_RDWR);
  for (int i = 0; i < kEndPatience_ms; ++i) {
    if (has_ended()) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

}  // namespace roomwise::create
