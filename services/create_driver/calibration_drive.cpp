#include "services/create_driver/calibration_drive.h"

#include <chrono>
#include <stdexcept>
#include <thread>

namespace roomwise::create {
namespace {

constexpr double kSpeed_mps = 0.15;
constexpr double kTurnRate_radps = 0.8;
constexpr auto kTick = std::chrono::milliseconds(5);
constexpr auto kRest = std::chrono::seconds(1);
constexpr auto kReadyPatience = std::chrono::seconds(10);
constexpr int kBumperBits = 3;

Instant now() {
  using std::chrono::time_point_cast;
  const auto steady = std::chrono::steady_clock::now().time_since_epoch();
  return {.steady = std::chrono::duration_cast<Duration>(steady),
          .wall = time_point_cast<Duration>(std::chrono::system_clock::now())};
}

bool sees_cliff(const SensorPackets& packets) {
  return packets[Packet::kCliffLeft] != 0 || packets[Packet::kCliffFrontLeft] != 0 ||
         packets[Packet::kCliffFrontRight] != 0 || packets[Packet::kCliffRight] != 0;
}

}  // namespace

CalibrationDrive::CalibrationDrive(const CreateParams& params, const std::atomic<bool>& is_over)
    : driver_(params), link_(params), is_over_(is_over) {
  if (model_of(params) == Model::kCreate1) {
    throw std::runtime_error("a Create 1 has no encoders to calibrate");
  }
  wait_until_ready();
}

void CalibrationDrive::wait_until_ready() {
  const auto end = std::chrono::steady_clock::now() + kReadyPatience;
  while (state_ != DriverState::kDriving) {
    if (std::chrono::steady_clock::now() > end) {
      throw std::runtime_error(link_.is_open() ? "the robot does not get ready to drive"
                                               : link_.error());
    }
    turn_over(0.0, 0.0);
  }
}

WheelTicks CalibrationDrive::straight(double distance_m) {
  ticks_ = {};
  distance_m_ = 0.0;
  while (distance_m_ < distance_m) turn_over(kSpeed_mps, 0.0);
  come_to_rest();
  return ticks_;
}

WheelTicks CalibrationDrive::spin(double turn_rad) {
  ticks_ = {};
  turn_rad_ = 0.0;
  while (turn_rad_ < turn_rad) turn_over(0.0, kTurnRate_radps);
  come_to_rest();
  return ticks_;
}

void CalibrationDrive::come_to_rest() {
  const auto end = std::chrono::steady_clock::now() + kRest;
  stand_while([&] { return std::chrono::steady_clock::now() < end; });
}

void CalibrationDrive::turn_over(double speed_mps, double turn_rate_radps) {
  if (is_over_) throw std::runtime_error("stopped");
  const Instant time = now();
  if (!link_.is_open() && link_.open_if_due(time.steady)) driver_.port_opened(now());
  if (link_.is_open()) {
    driver_.command(time, {.speed_mps = speed_mps,
                           .turn_rate_radps = turn_rate_radps,
                           .decided = time.wall,
                           .expiry = time.wall + kCommandLife,
                           .session = 1,
                           .sequence = ++sequence_,
                           .proof = Proof::kGenuine});  // of no bus: its own
    link_.send(time.steady, driver_.step(time, link_.receive()));
    link_.set_wake_line(driver_.pulls_wake_line(time.steady));
    for (const FrameReport& report : driver_.reports()) add(report);
  }
  const bool moves = speed_mps != 0.0 || turn_rate_radps != 0.0;
  if (moves && (state_ != DriverState::kDriving || !link_.is_open())) {
    throw std::runtime_error("the robot stopped obeying on the way");
  }
  std::this_thread::sleep_for(kTick);
}

void CalibrationDrive::add(const FrameReport& report) {
  const auto delta = [&](Packet packet) {
    return encoder_delta_ticks(static_cast<std::uint16_t>(packets_[packet]),
                               static_cast<std::uint16_t>(report.packets[packet]));
  };
  if (has_reading_) {
    ticks_.left += delta(Packet::kEncoderLeft);
    ticks_.right += delta(Packet::kEncoderRight);
  }
  if (report.odometry) {
    distance_m_ += report.odometry->distance_m;
    turn_rad_ += report.odometry->turn_rad;
  }
  state_ = report.state;
  packets_ = report.packets;
  has_reading_ = true;
  if (report.commanded == WheelSpeeds{}) return;
  if ((packets_[Packet::kBumpsAndDrops] & kBumperBits) != 0) {
    throw std::runtime_error("the robot ran into something");
  }
  if (sees_cliff(packets_)) throw std::runtime_error("the robot came to an edge");
}

}  // namespace roomwise::create
