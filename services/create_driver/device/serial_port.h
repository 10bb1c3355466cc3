#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "services/create_driver/device/file_descriptor.h"

namespace roomwise::create {

/// A serial line of our own: 8 data bits, no parity, 1 stop bit, no flow control, never blocking.
class SerialPort {
 public:
  /// Opens the terminal at `path`. Throws std::runtime_error naming it and what is wrong: not
  /// there, no permission, no terminal, in use by another process, speed not supported.
  SerialPort(const std::filesystem::path& path, int baud);

  /// Appends what has arrived. False: the line is gone (unplugged, hung up).
  [[nodiscard]] bool read(std::vector<std::uint8_t>& bytes);

  /// Sends all of `bytes`. False: the line is gone or does not take them within 20 ms.
  [[nodiscard]] bool write(std::span<const std::uint8_t> bytes);

  /// Pulls "rts" or "dtr" low or lets it go; a line without modem lines, or "none", does nothing.
  void set_wake_line(const std::string& line, bool is_low);

  int fd() const { return fd_.get(); }

 private:
  FileDescriptor fd_;
};

}  // namespace roomwise::create
