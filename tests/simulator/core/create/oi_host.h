#pragma once
#include <initializer_list>
#include <numeric>
#include <vector>

#include "services/simulator/core/create/open_interface.h"

namespace roomwise::simulator {

using Bytes = std::vector<std::uint8_t>;

/// A host on a line without delay, and a robot whose readings it sets by hand.
class OiHost {
 public:
  explicit OiHost(const OpenInterfaceParams& params = {}) : interface(params) {
    interface.step(now);
  }

  void send(const Bytes& bytes) {
    for (const std::uint8_t byte : bytes) interface.receive(byte);
  }

  /// Sends a query and returns its reply.
  Bytes ask(const Bytes& bytes) {
    interface.take_transmissions();
    send(bytes);
    return all_received();
  }

  /// Lets sensor periods go by with `readings`; what came in them.
  std::vector<Transmission> wait(int periods) {
    std::vector<Transmission> received;
    for (int i = 0; i < periods; ++i) {
      now += OpenInterface::kSensorPeriod;
      interface.step(now);
      interface.sense(readings);
      for (Transmission& sent : interface.take_transmissions()) received.push_back(std::move(sent));
    }
    return received;
  }

  Bytes all_received() {
    Bytes bytes;
    for (const Transmission& sent : interface.take_transmissions()) {
      bytes.insert(bytes.end(), sent.bytes.begin(), sent.bytes.end());
    }
    return bytes;
  }

  int mode_byte() { return ask({142, 35}).at(0); }

  Duration now{};
  BodyReadings readings;
  OpenInterface interface;
};

/// All bytes of a frame sum to 0 modulo 256.
inline bool sums_to_zero(const Bytes& frame) {
  return (std::accumulate(frame.begin(), frame.end(), 0) & 0xFF) == 0;
}

inline int word_at(const Bytes& bytes, std::size_t at) {
  return static_cast<std::int16_t>(bytes.at(at) << 8 | bytes.at(at + 1));
}

}  // namespace roomwise::simulator
