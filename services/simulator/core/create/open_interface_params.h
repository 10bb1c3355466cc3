#pragma once
#include <string>

namespace roomwise::simulator {

/// Which Create it is and which of its quirks it shows.
struct OpenInterfaceParams {
  std::string model = "create2";
  /// What becomes of a fraction of a degree or millimetre when packets 19 and 20 are read:
  /// "truncate" forgets it, "carry" keeps it for the next read.
  std::string odometry_rounding = "truncate";
  /// "3.7.7" counts right; "3.4.0" scales packet 20 by 0.324056; "3.2.6" halves packet 19 as well
  /// (the maker says only that it is wrong).
  std::string firmware = "3.7.7";
  std::string mode_byte = "standard";  ///< "plus_one": packet 35 as some 600-series units send it
  /// "without_header": the sum the Create's manual of 2006 prints.
  std::string checksum = "with_header";
  bool locks_after_trip = false;  ///< reports mode 32 after a trip and ignores 128 to 132
  double mode_settle_s = 0.0;     ///< bytes within this time of a mode command are lost
  double boot_s = 1.5;            ///< deaf after a reset
  double sleep_after_s = 300.0;   ///< in Passive without a mode command
};

}  // namespace roomwise::simulator
