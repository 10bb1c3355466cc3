#pragma once
#include <vector>

#include "common/time.h"
#include "services/simulator/core/create/fault.h"
#include "services/simulator/core/create/open_interface.h"

namespace roomwise::simulator {

/// Spoils stream frames on their way to the host, as the faults that concern them say.
class LineFaults {
 public:
  explicit LineFaults(const std::vector<Fault>& faults);

  /// Spoils what of `transmissions` is due by `now`; a frame meets one fault at most.
  void spoil(Duration now, std::vector<Transmission>& transmissions);

 private:
  std::vector<Fault> waiting_;  // `count` is what is left to do
};

}  // namespace roomwise::simulator
