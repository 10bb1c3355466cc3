#pragma once
#include <memory>
#include <utility>
#include <vector>

namespace roomwise {

/// OpenNI2's player (2.2.0.33) looks at its streams while they are freed, and crashes: a recording
/// that was opened, with its streams, stays so until the process ends.
template <class Opened>
void keep_open(std::unique_ptr<Opened> opened) {
  static auto& kept = *new std::vector<std::unique_ptr<Opened>>();
  kept.push_back(std::move(opened));
}

}  // namespace roomwise
