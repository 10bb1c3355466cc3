#include "services/create_driver/device/robot_link.h"

#include <chrono>
#include <stdexcept>

#include "services/create_driver/core/oi_encoder.h"

namespace roomwise::create {
namespace {

constexpr Duration kRetryPeriod = std::chrono::milliseconds(250);
constexpr Duration kBeatPeriod = std::chrono::milliseconds(20);

}  // namespace

RobotLink::RobotLink(const CreateParams& params) : params_(params) {}

RobotLink::~RobotLink() { close(); }

bool RobotLink::open_if_due(Duration now) {
  if (now < next_try_) return false;
  next_try_ = now + kRetryPeriod;
  try {
    open();
    return true;
  } catch (const std::runtime_error& error) {
    error_ = error.what();
    port_.reset();
    return false;
  }
}

void RobotLink::open() {
  port_.emplace(params_.port, baud_of(params_));
  guardian_.emplace(guardian_program(), port_->fd());
  wake_line_is_low_ = false;
  port_->set_wake_line(params_.wake_line, false);
  error_.clear();
}

std::span<const std::uint8_t> RobotLink::receive() {
  received_.clear();
  if (is_open() && !port_->read(received_)) lose("hung up");
  return received_;
}

void RobotLink::send(Duration now, std::span<const std::uint8_t> bytes) {
  if (!is_open()) return;
  if (!port_->write(bytes)) return lose("does not take what is sent");
  if (now - last_beat_ < kBeatPeriod) return;
  last_beat_ = now;
  if (!guardian_->beat()) lose("create_guardian is gone; nobody drives without it");
}

void RobotLink::set_wake_line(bool is_low) {
  if (!is_open() || is_low == wake_line_is_low_) return;
  port_->set_wake_line(params_.wake_line, is_low);
  wake_line_is_low_ = is_low;
}

void RobotLink::lose(const std::string& why) {
  error_ = "serial port " + params_.port + ": " + why;
  close();
}

void RobotLink::close() noexcept {
  if (port_) (void)port_->write(kStopAndRest);  // if the line is gone, there is nothing to be done
  port_.reset();
  guardian_.reset();
}

}  // namespace roomwise::create
