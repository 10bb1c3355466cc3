// Loaded before the C library, makes a process read the wall clock as if it had been set: the file
// that ROOMWISE_TEST_CLOCK names holds the step in nanoseconds (int64), and may change meanwhile.
// The steady clock is left alone, as setting a clock leaves it.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <ctime>

namespace {

constexpr std::int64_t kNanoseconds = 1'000'000'000;

const std::atomic<std::int64_t>* step_file() {
  static const std::atomic<std::int64_t> kNone{0};
  const char* path = std::getenv("ROOMWISE_TEST_CLOCK");
  const int file = path == nullptr ? -1 : ::open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return &kNone;
  void* at = ::mmap(nullptr, sizeof kNone, PROT_READ, MAP_SHARED, file, 0);
  ::close(file);
  return at == MAP_FAILED ? &kNone : static_cast<const std::atomic<std::int64_t>*>(at);
}

}  // namespace

extern "C" int clock_gettime(clockid_t clock, timespec* time) noexcept {
  static const std::atomic<std::int64_t>* const kStep = step_file();
  const long result = ::syscall(SYS_clock_gettime, clock, time);
  if (result != 0 || clock != CLOCK_REALTIME) return static_cast<int>(result);
  const std::int64_t moved = time->tv_sec * kNanoseconds + time->tv_nsec + kStep->load();
  time->tv_sec = moved / kNanoseconds;
  time->tv_nsec = moved % kNanoseconds;
  return 0;
}

extern "C" int gettimeofday(timeval* time, void* /*zone*/) noexcept {
  timespec now{};
  const int result = ::clock_gettime(CLOCK_REALTIME, &now);
  time->tv_sec = now.tv_sec;
  time->tv_usec = now.tv_nsec / 1000;
  return result;
}
