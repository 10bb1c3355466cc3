#include "services/simulator/simulator_service.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "services/simulator/simulator_messages.h"
#include "services/simulator/world_setup.h"

namespace roomwise::simulator {
namespace {

constexpr Duration kTick{2'000};
/// Bytes taken from the port ahead of the line's pace; the rest waits in the terminal, and its
/// writer with it.
constexpr std::size_t kReadAhead = 256;

std::filesystem::path port_link(const SimulatorParams& params) {
  if (!params.create_port.empty()) return params.create_port;
  return fmt::format("/tmp/roomwise-{}/create", ::getuid());
}

std::filesystem::path door_of(const SimulatorParams& params) {
  if (params.kinect_door.empty()) return default_frame_door();
  return params.kinect_door;
}

Bus& live(Bus& bus) {
  if (bus.is_replay()) throw std::runtime_error("a simulator has no input that could be replayed");
  return bus;
}

}  // namespace

SimulatorService::SimulatorService(Bus& bus, const Params& params)
    : bus_(live(bus)),
      longest_catch_up_(
          std::chrono::duration_cast<Duration>(std::chrono::duration<double>(params.catch_up_s))),
      world_(world_of(params)),
      port_(port_link(params)),
      real_time_(bus.now()),
      plug_camera_([this, params] { camera_.emplace(world_.scene(), params, door_of(params)); }) {
  plug_camera_();
  spdlog::info("simulator: {}; Create on {}, Kinect behind {}", world_.scene().name,
               port_link(params).string(), door_of(params).string());
  bus_.every(kTick, [this](Time) { advance(); });
}

void SimulatorService::advance() {
  if (real_time_.follow(bus_.now())) bus_.count("wall_clock_set");
  const Duration behind = real_time_.elapsed() - world_.now();
  if (behind > longest_catch_up_) {
    real_time_.skip(behind - longest_catch_up_);
    bus_.count("skipped_ms", (behind - longest_catch_up_).count() / 1000);
  }
  listen();
  const Duration until = real_time_.elapsed();
  while (world_.now() + SimulatedCreate::kStep <= until) step();
  answer();
}

void SimulatorService::listen() {
  SimulatedCreate& create = world_.create();
  if (!port_.is_open()) return;
  if (const int baud = port_.host_baud(); baud > 0) create.set_host_baud(baud);
  from_host_.clear();
  port_.read(kReadAhead - std::min(kReadAhead, create.bytes_waiting()), from_host_);
  create.receive(from_host_);
}

void SimulatorService::step() {
  world_.step(to_host_);
  const Duration now = world_.now();
  if (is_due(now, kTruthRate_hz)) {
    truth_t truth = truth_message(world_, real_time_.stamp(now), is_due(now, kLandmarkRate_hz));
    bus_.publish(channels::kTruth, truth);
  }
  if (is_due(now, kCameraRate_hz)) show();
}

/// To the camera, which may be pulled out and plugged in again.
void SimulatorService::show() {
  if (!world_.has_camera()) return camera_.reset();
  if (!camera_) {
    plug_camera_();
    camera_moments_dropped_ = 0;
  }
  camera_->take({real_time_.stamp(world_.now()), world_.now(), world_.T_world_camera()});
}

void SimulatorService::answer() {
  const SimulatedCreate& create = world_.create();
  if (create.has_port() && !port_.is_open()) port_.reopen();
  if (!create.has_port() && port_.is_open()) port_.hang_up();
  if (const std::size_t lost = port_.write(to_host_); lost > 0) {
    bus_.count("port_bytes_lost", static_cast<std::int64_t>(lost));
  }
  to_host_.clear();
  const std::int64_t line_lost =
      create.bytes_lost() - std::exchange(line_bytes_lost_, create.bytes_lost());
  if (line_lost > 0) bus_.count("line_bytes_lost", line_lost);
  if (!camera_) return;
  const std::int64_t dropped =
      camera_->dropped() - std::exchange(camera_moments_dropped_, camera_->dropped());
  if (dropped > 0) bus_.count("camera_moments_dropped", dropped);
}

}  // namespace roomwise::simulator
