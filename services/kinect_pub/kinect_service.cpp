#include "services/kinect_pub/kinect_service.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace roomwise {
namespace {

using State = CaptureReport::State;

/// `bus` if there is a camera to read beside it.
Bus& live(Bus& bus) {
  if (bus.is_replay()) {
    throw std::runtime_error(
        "has nothing to replay: it makes KINECT_FRAME from a camera or an .oni recording "
        "(parameter device)");
  }
  return bus;
}

bool is_recording(const std::string& device) { return device.ends_with(".oni"); }

/// A recording's path must hold while OpenNI2 has changed the working folder.
kinect::KinectParams with_absolute_paths(kinect::KinectParams params) {
  if (!is_recording(params.device)) return params;
  if (!std::filesystem::is_regular_file(params.device)) {
    throw std::runtime_error(params.device + ": no such recording");
  }
  params.device = std::filesystem::absolute(params.device);
  return params;
}

std::int64_t microseconds(double duration_s) { return static_cast<std::int64_t>(duration_s * 1e6); }

Capture::Settings settings_of(const kinect::KinectParams& params) {
  const bool vga = params.resolution == "640x480";
  return {.camera = {.uri = params.device,
                     .width_px = vga ? 640 : 320,
                     .height_px = vga ? 480 : 240,
                     .use_color = params.use_color,
                     .register_depth = params.register_depth,
                     .pair_tolerance_us = microseconds(params.pair_tolerance_s),
                     .loop_recording = params.loop_recording,
                     .recording_is_registered = params.recording_is_registered},
          .clock = {.window_us = microseconds(params.clock_window_s),
                    .exposure_delay_us = microseconds(params.exposure_delay_s)},
          .silence_max = Duration(microseconds(params.silence_max_s)),
          .start_max = Duration(microseconds(params.start_max_s))};
}

std::int8_t state_of(State state) {
  switch (state) {
    case State::kStreaming:
      return device_status_t::STATE_STREAMING;
    case State::kLost:
      return device_status_t::STATE_LOST;
    case State::kEnded:
      return device_status_t::STATE_ENDED;
    case State::kSearching:
      break;
  }
  return device_status_t::STATE_SEARCHING;
}

void describe(const CameraFacts& facts, device_status_t& status) {
  status.device_name = facts.name;
  status.device_uri = facts.uri;
  status.device_serial = facts.serial;
  status.depth_width_px = facts.depth_width_px;
  status.depth_height_px = facts.depth_height_px;
  status.color_width_px = facts.color_width_px;
  status.color_height_px = facts.color_height_px;
  status.registration_in_force = facts.depth_registered ? 1 : 0;
  status.mirrored_by_device = facts.mirrored_by_device ? 1 : 0;
}

}  // namespace

KinectService::KinectService(Bus& bus, const Params& params)
    : bus_(live(bus)), params_(with_absolute_paths(params)) {
  status_.backend = library_.version();
  status_.registration_asked = params_.register_depth && params_.use_color ? 1 : 0;
  const Capture::Settings settings = settings_of(params_);
  if (is_recording(params_.device)) OpenNiCamera(library_, settings.camera);  // throws if it is bad
  bus_.every(std::chrono::seconds(1), [this](Time time) { report_second(time); });
  worker_ = std::make_unique<FrameWorker>(params_, frames_, messages_,
                                          [this] { bus_.post([this] { publish_frame(); }); });
  capture_ = std::make_unique<Capture>(
      library_, settings, frames_, [this] { return bus_.now(); },
      [this] { bus_.post([this] { publish_status(bus_.now()); }); });
}

KinectService::~KinectService() = default;

void KinectService::publish_frame() {
  if (!messages_.try_take(message_)) return;
  bus_.publish(channels::kKinectFrame, message_);
  ++status_.frames_published;
}

void KinectService::report_second(Time time) {
  const FrameWorker::Cost cost = worker_->take_cost();
  const double frames = static_cast<double>(std::max<std::int64_t>(cost.frames, 1));
  status_.encode_mean_s = 1e-6 * static_cast<double>(cost.sum_us) / frames;
  status_.encode_max_s = std::max(status_.encode_max_s, 1e-6 * static_cast<double>(cost.max_us));
  status_.frame_rate_hz = static_cast<double>(status_.frames_published - frames_at_last_second_);
  frames_at_last_second_ = status_.frames_published;
  bus_.count("encode_us", cost.sum_us);
  publish_status(time);
}

void KinectService::publish_status(Time time) {
  const CaptureReport report = capture_->report();
  say_changes(report);
  describe(report.facts, status_);
  status_.utime = utime_of(time);
  status_.state = state_of(report.state);
  status_.frames_dropped = report.frames_dropped + worker_->dropped();
  status_.depth_unpaired = report.depth_unpaired;
  status_.color_unpaired = report.color_unpaired;
  status_.frames_malformed = report.malformed;
  status_.device_losses = report.losses;
  status_.reconnects = report.reconnects;
  status_.clock_restarts = report.clock_restarts;
  status_.clock_offset_us = report.clock_offset_us;
  status_.last_error = report.error;
  count_up_to("frames_dropped", status_.frames_dropped);
  count_up_to("depth_unpaired", report.depth_unpaired);
  count_up_to("color_unpaired", report.color_unpaired);
  count_up_to("frames_malformed", report.malformed);
  count_up_to("device_losses", report.losses);
  bus_.publish(channels::kKinectStatus, status_);
}

void KinectService::say_changes(const CaptureReport& report) {
  std::string line = report.error;
  if (report.state == State::kStreaming) {
    line = report.facts.name + " " + report.facts.uri + ": streaming";
  } else if (report.state == State::kEnded) {
    line = report.facts.uri + ": played to its end";
  }
  if (line.empty() || line == said_) return;
  said_ = line;
  const bool bad = !report.error.empty();
  spdlog::log(bad ? spdlog::level::err : spdlog::level::info, "kinect_pub: {}", line);
  if (bad) bus_.note_error(line);
}

void KinectService::count_up_to(const std::string& counter, std::int64_t total) {
  std::int64_t& counted = counted_[counter];
  if (total > counted) bus_.count(counter, total - counted);
  counted = total;
}

}  // namespace roomwise
