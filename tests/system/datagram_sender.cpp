#include "tests/system/datagram_sender.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <thread>

namespace roomwise {
namespace {

using Bytes = std::vector<std::uint8_t>;

// LCM 1.3.1, udpm_util.h: first word of a whole message and of a fragment.
constexpr std::uint32_t kShortMagic = 0x4c433032;
constexpr std::uint32_t kFragmentMagic = 0x4c433033;

void put(Bytes& bytes, std::uint32_t value, int size) {
  for (int i = size; i-- > 0;) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

Bytes fragment(std::uint32_t message_size, std::uint32_t offset, std::uint32_t number,
               std::uint32_t count, const std::string& rest) {
  Bytes bytes;
  put(bytes, kFragmentMagic, 4);
  put(bytes, 99, 4);
  put(bytes, message_size, 4);
  put(bytes, offset, 4);
  put(bytes, number, 2);
  put(bytes, count, 2);
  bytes.insert(bytes.end(), rest.begin(), rest.end());
  return bytes;
}

}  // namespace

DatagramSender::DatagramSender() : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
  if (socket_ < 0) throw std::runtime_error("no UDP socket");
  group_.sin_family = AF_INET;
  group_.sin_port = htons(27667);
  ::inet_pton(AF_INET, "239.255.76.67", &group_.sin_addr);
}

DatagramSender::~DatagramSender() { ::close(socket_); }

void DatagramSender::send(const std::string& channel, const Bytes& payload) {
  Bytes datagram;
  put(datagram, kShortMagic, 4);
  put(datagram, sequence_++, 4);
  datagram.insert(datagram.end(), channel.begin(), channel.end());
  datagram.push_back(0);
  datagram.insert(datagram.end(), payload.begin(), payload.end());
  send_raw(datagram);
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

void DatagramSender::send_raw(const Bytes& datagram) {
  const auto* address = reinterpret_cast<const sockaddr*>(&group_);
  ::sendto(socket_, datagram.data(), datagram.size(), 0, address, sizeof group_);
}

std::vector<Bytes> malformed_lcm_packets() {
  Bytes endless_channel;
  put(endless_channel, kShortMagic, 4);
  put(endless_channel, 1, 4);
  endless_channel.insert(endless_channel.end(), 2000, 'A');
  const std::string named = std::string("POSE") + '\0' + "payload";
  return {{},
          {0x4c},
          Bytes(4, 0),
          Bytes(1400, 0xAB),
          endless_channel,
          fragment(1000, 0, 0, 2, named),
          fragment(1000, 2000, 1, 2, "beyond its message"),
          fragment(1000, 0, 5, 2, "number past count"),
          fragment(0, 0, 0, 0, named)};
}

}  // namespace roomwise
