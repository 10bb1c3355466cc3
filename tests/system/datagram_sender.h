#pragma once
#include <netinet/in.h>

#include <cstdint>
#include <string>
#include <vector>

namespace roomwise {

/// Sends UDP datagrams to the tests' multicast group as LCM would, or as it never would.
class DatagramSender {
 public:
  /// Throws std::runtime_error if the kernel gives no socket.
  DatagramSender();
  DatagramSender(const DatagramSender&) = delete;
  DatagramSender& operator=(const DatagramSender&) = delete;
  ~DatagramSender();

  /// `payload` on `channel`, in one well-formed LCM packet (at most 60 kB); then a short pause, so
  /// that a receiver of stream messages has read it before the next comes.
  void send(const std::string& channel, const std::vector<std::uint8_t>& payload);

  /// These very bytes.
  void send_raw(const std::vector<std::uint8_t>& datagram);

 private:
  int socket_;
  sockaddr_in group_{};
  std::uint32_t sequence_ = 0;
};

/// Datagrams that are not LCM packets: cut headers, unknown magic, endless channel names, fragments
/// that lie about their message.
std::vector<std::vector<std::uint8_t>> malformed_lcm_packets();

}  // namespace roomwise
