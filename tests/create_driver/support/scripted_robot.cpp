#include "tests/create_driver/support/scripted_robot.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

namespace roomwise::create {
namespace {

constexpr std::array<std::uint8_t, 1> kStreamIds = {100};
constexpr double kTicksPerMillimetre = 508.8 / (3.14159265358979 * 72.0);

/// Data bytes after an opcode; the stream request's count is its first data byte.
std::size_t data_size(std::uint8_t opcode, const std::vector<std::uint8_t>& after) {
  switch (static_cast<Opcode>(opcode)) {
    case Opcode::kDrive:
    case Opcode::kDriveDirect:
      return 4;
    case Opcode::kStream:
      return after.empty() ? 1 : 1U + after[0];
    case Opcode::kBaud:
    case Opcode::kSensors:
    case Opcode::kPauseStream:
      return 1;
    default:
      return 0;
  }
}

int word(const std::vector<std::uint8_t>& data, std::size_t at) {
  return static_cast<std::int16_t>(data[at] << 8 | data[at + 1]);
}

}  // namespace

ScriptedRobot::ScriptedRobot(std::filesystem::path link) : link_(std::move(link)) {
  std::array<char, 128> name{};
  termios raw{};
  ::cfmakeraw(&raw);
  if (::openpty(&master_, &slave_, name.data(), &raw, nullptr) != 0) {
    throw std::runtime_error("no pseudo-terminal");
  }
  ::fcntl(master_, F_SETFL, O_NONBLOCK);
  ::fcntl(master_, F_SETFD, FD_CLOEXEC);
  ::fcntl(slave_, F_SETFD, FD_CLOEXEC);
  std::filesystem::remove(link_);
  std::filesystem::create_symlink(name.data(), link_);
  thread_ = std::thread([this] { run(); });
}

ScriptedRobot::~ScriptedRobot() {
  is_over_ = true;
  thread_.join();
  std::filesystem::remove(link_);
  ::close(slave_);
  ::close(master_);
}

void ScriptedRobot::run() {
  auto next_frame = Clock::now();
  while (!is_over_) {
    pollfd readable{.fd = master_, .events = POLLIN, .revents = 0};
    ::poll(&readable, 1, 2);
    read_commands();
    if (Clock::now() < next_frame) continue;
    next_frame += std::chrono::milliseconds(15);
    send_frame();
  }
}

void ScriptedRobot::read_commands() {
  const std::scoped_lock lock(mutex_);
  std::array<std::uint8_t, 256> bytes{};
  const ssize_t count = ::read(master_, bytes.data(), bytes.size());
  if (count > 0) pending_.insert(pending_.end(), bytes.begin(), bytes.begin() + count);
  while (!pending_.empty()) {
    const std::vector<std::uint8_t> after(pending_.begin() + 1, pending_.end());
    const std::size_t size = data_size(pending_[0], after);
    if (after.size() < size) return;
    obey(pending_[0], {after.begin(), after.begin() + static_cast<std::ptrdiff_t>(size)});
    pending_.erase(pending_.begin(), pending_.begin() + static_cast<std::ptrdiff_t>(1 + size));
  }
}

void ScriptedRobot::obey(std::uint8_t opcode, const std::vector<std::uint8_t>& data) {
  if (opcode == 0) return;
  opcodes_.push_back(opcode);
  const bool drives = mode_ == OiMode::kSafe || mode_ == OiMode::kFull;
  switch (static_cast<Opcode>(opcode)) {
    case Opcode::kStart:
      return enter(OiMode::kPassive);
    case Opcode::kSafe:
      return mode_ == OiMode::kOff ? void() : enter(OiMode::kSafe);
    case Opcode::kFull:
      return mode_ == OiMode::kOff ? void() : enter(OiMode::kFull);
    case Opcode::kReset:
      is_streaming_ = false;
      return enter(OiMode::kOff);
    case Opcode::kStream:
      is_streaming_ = mode_ != OiMode::kOff;
      return;
    case Opcode::kDriveDirect:
      if (drives) set_wheels({word(data, 2), word(data, 0)});
      return;
    default:
      return;
  }
}

void ScriptedRobot::enter(OiMode mode) {
  mode_ = mode;
  if (mode == OiMode::kPassive || mode == OiMode::kOff) set_wheels({});
}

void ScriptedRobot::set_wheels(Wheels wheels) {
  if (wheels == Wheels{} && wheels_ != Wheels{}) stopped_at_ = Clock::now();
  wheels_ = wheels;
}

void ScriptedRobot::send_frame() {
  const std::scoped_lock lock(mutex_);
  left_ticks_ += 0.015 * wheels_.left_mmps * kTicksPerMillimetre;
  right_ticks_ += 0.015 * wheels_.right_mmps * kTicksPerMillimetre;
  std::vector<std::uint8_t> bytes(text_.begin(), text_.end());
  text_.clear();
  if (is_streaming_) {
    SensorPackets packets;
    packets.set(Packet::kOiMode, static_cast<int>(mode_));
    packets.set(Packet::kVoltage_mv, 14500);
    packets.set(Packet::kRequestedLeft_mmps, wheels_.left_mmps);
    packets.set(Packet::kRequestedRight_mmps, wheels_.right_mmps);
    packets.set(Packet::kEncoderLeft, static_cast<int>(left_ticks_));
    packets.set(Packet::kEncoderRight, static_cast<int>(right_ticks_));
    append_stream_frame(kStreamIds, packets, bytes);
  }
  // What does not fit is lost, as on a serial line nobody reads.
  [[maybe_unused]] const ssize_t sent = ::write(master_, bytes.data(), bytes.size());
}

OiMode ScriptedRobot::mode() const {
  const std::scoped_lock lock(mutex_);
  return mode_;
}

ScriptedRobot::Wheels ScriptedRobot::wheels() const {
  const std::scoped_lock lock(mutex_);
  return wheels_;
}

ScriptedRobot::Clock::time_point ScriptedRobot::stopped_at() const {
  const std::scoped_lock lock(mutex_);
  return stopped_at_;
}

std::vector<std::uint8_t> ScriptedRobot::opcodes() const {
  const std::scoped_lock lock(mutex_);
  return opcodes_;
}

void ScriptedRobot::trip() {
  const std::scoped_lock lock(mutex_);
  enter(OiMode::kPassive);
}

void ScriptedRobot::print(const std::string& text) {
  const std::scoped_lock lock(mutex_);
  text_ += text;
}

}  // namespace roomwise::create
