// LogReader on a file of any bytes. Every byte must be either in an event or reported as damage.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <stdexcept>
#include <string>

#include "common/bus/log_file.h"

namespace {

constexpr std::uint64_t kEventHeaderBytes = 28;

std::uint64_t bytes_accounted_for(roomwise::LogReader& reader) {
  std::uint64_t total = 0;
  roomwise::LogEvent event;
  while (reader.next(event)) total += kEventHeaderBytes + event.channel.size() + event.data.size();
  for (const auto& damage : reader.damage()) total += damage.resumed_byte - damage.first_byte;
  return total;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const int file = memfd_create("fuzz.lcmlog", 0);
  if (file < 0 || write(file, data, size) != static_cast<ssize_t>(size)) {
    throw std::runtime_error("cannot make a file in memory");
  }
  {
    roomwise::LogReader reader("/proc/self/fd/" + std::to_string(file));
    if (bytes_accounted_for(reader) != size || reader.position_bytes() != size) __builtin_trap();
  }
  close(file);
  return 0;
}
