#include "common/service/process_use.h"

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

namespace roomwise {

ProcessUse process_use() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  std::int64_t all_pages = 0;
  std::int64_t resident_pages = 0;
  std::ifstream("/proc/self/statm") >> all_pages >> resident_pages;
  return {.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime),
          .memory_bytes = resident_pages * ::sysconf(_SC_PAGESIZE)};
}

}  // namespace roomwise
