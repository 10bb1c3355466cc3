#pragma once

namespace roomwise::simulator {

/// Something a robot has two of.
template <class T>
struct LeftRight {
  T left{};
  T right{};
  friend bool operator==(const LeftRight&, const LeftRight&) = default;
};

}  // namespace roomwise::simulator
