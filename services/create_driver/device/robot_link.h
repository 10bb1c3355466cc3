#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/time.h"
#include "services/create_driver/core/create_params.h"
#include "services/create_driver/device/guardian.h"
#include "services/create_driver/device/serial_port.h"

namespace roomwise::create {

/// The line to the robot: a serial port and the guardian that shares it, opened together and given
/// up together. However it is given up, the robot is told to stop.
class RobotLink {
 public:
  explicit RobotLink(const CreateParams& params);
  ~RobotLink();
  RobotLink(const RobotLink&) = delete;
  RobotLink& operator=(const RobotLink&) = delete;

  bool is_open() const { return guardian_.has_value(); }

  /// Tries to open it, every quarter of a second; `now` is of the steady clock. True when it has
  /// opened. What is in the way is then in error().
  bool open_if_due(Duration now);

  /// What has arrived since the last call. When the line is lost it is closed, and error() says
  /// how.
  std::span<const std::uint8_t> receive();

  /// Sends, and lets the guardian know that all is well. Loses the line as receive() does.
  void send(Duration now, std::span<const std::uint8_t> bytes);

  void set_wake_line(bool is_low);

  /// What went wrong last, in words.
  const std::string& error() const { return error_; }

 private:
  void open();
  void lose(const std::string& why);
  void close() noexcept;

  CreateParams params_;
  std::optional<SerialPort> port_;
  std::optional<Guardian> guardian_;
  std::vector<std::uint8_t> received_;
  bool wake_line_is_low_ = false;
  Duration next_try_{};
  Duration last_beat_{};
  std::string error_;
};

}  // namespace roomwise::create
