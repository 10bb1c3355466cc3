#pragma once
#include "common/create/open_interface.h"

namespace roomwise::create {

/// Packet 35 as the robot in hand means it. Some robots report one more than the manual says; after
/// Start, which always leads to Passive, such a robot says 2.
class ModeReading {
 public:
  /// Learns from the byte a robot reports in Passive. False if it can be no such byte.
  bool learn_in_passive(int byte) {
    if (byte != 1 && byte != 2) return false;
    offset_ = byte - 1;
    return true;
  }

  OiMode mode(int byte) const {
    const int mode = byte - offset_;
    const bool is_listed = byte >= 0 && mode <= static_cast<int>(OiMode::kFull);
    if (!is_listed) return OiMode::kUnknown;
    return mode < 0 ? OiMode::kOff : static_cast<OiMode>(mode);
  }

  bool is_offset() const { return offset_ != 0; }

 private:
  int offset_ = 0;
};

}  // namespace roomwise::create
