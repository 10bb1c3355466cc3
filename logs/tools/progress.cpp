#include "logs/tools/progress.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>

namespace roomwise {

Progress::Progress(std::string what, std::uint64_t total)
    : what_(std::move(what)),
      total_(std::max<std::uint64_t>(total, 1)),
      on_terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (on_terminal_) fmt::print(stderr, "\r\x1b[K");
}

void Progress::show(std::uint64_t done) {
  const std::uint64_t percent = std::min<std::uint64_t>(100, 100 * done / total_);
  if (!on_terminal_ || percent == shown_percent_) return;
  shown_percent_ = percent;
  fmt::print(stderr, "\r{} {} %", what_, percent);
  std::fflush(stderr);
}

}  // namespace roomwise
