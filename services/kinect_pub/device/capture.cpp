#include "services/kinect_pub/device/capture.h"

#include <chrono>
#include <exception>

namespace roomwise {
namespace {

/// How soon a stop, or a device reported gone, is seen.
constexpr std::chrono::milliseconds kReadPatience{50};
/// How often an ended recording's thread looks whether to stop.
constexpr std::chrono::milliseconds kEndedPatience{200};

}  // namespace

Capture::Capture(OpenNiLibrary& library, const Settings& settings,
                 LatestSlot<CapturedFrame>& frames, std::function<Time()> now,
                 std::function<void()> changed)
    : library_(library),
      settings_(settings),
      frames_(frames),
      now_(std::move(now)),
      changed_(std::move(changed)),
      clock_(settings.clock),
      thread_([this] { run(); }) {}

Capture::~Capture() {
  stopping_ = true;
  library_.wake();
  thread_.join();
}

CaptureReport Capture::report() const {
  const std::lock_guard lock(mutex_);
  return report_;
}

void Capture::set_state(State state, const std::string& error) {
  {
    const std::lock_guard lock(mutex_);
    if (report_.state == state && report_.error == error) return;
    report_.state = state;
    report_.error = error;
  }
  changed_();
}

void Capture::run() {
  while (!stopping_) {
    try {
      use_camera();
    } catch (const std::exception& error) {
      const State state = report().losses > 0 ? State::kLost : State::kSearching;
      set_state(state, error.what());
    }
    while (!stopping_ && report().state == State::kEnded) library_.wait_for_device(kEndedPatience);
    if (!stopping_) library_.wait_for_device(backoff_.next());
  }
}

void Capture::use_camera() {
  OpenNiCamera camera(library_, settings_.camera);
  {
    const std::lock_guard lock(mutex_);
    report_.facts = camera.facts();
  }
  stream_from(camera);
  close_account(camera);
}

void Capture::stream_from(OpenNiCamera& camera) {
  using std::chrono::steady_clock;
  CapturedFrame frame;
  auto last_pair = steady_clock::now();
  Duration patience = settings_.start_max;
  while (!stopping_) {
    const OpenNiCamera::Read result = camera.read(kReadPatience, frame);
    account(camera);
    if (result == OpenNiCamera::Read::kEnded) return set_state(State::kEnded, "");
    if (result == OpenNiCamera::Read::kPair) {
      last_pair = steady_clock::now();
      patience = settings_.silence_max;
      hand_over(frame);
      continue;
    }
    const bool silent = steady_clock::now() - last_pair > patience;
    if (result != OpenNiCamera::Read::kLost && !silent) continue;
    const std::string& uri = camera.facts().uri;
    count_loss();
    return set_state(State::kLost,
                     silent ? uri + ": sends no pair of images" : uri + ": went away");
  }
}

void Capture::hand_over(CapturedFrame& frame) {
  const std::int64_t arrived_us = utime_of(now_());
  frame.utime = clock_.map(frame.device_time_us, arrived_us);
  const bool displaced = frames_.put(frame);
  {
    const std::lock_guard lock(mutex_);
    report_.frames_dropped += displaced ? 1 : 0;
    report_.clock_restarts = clock_.restarts();
    report_.clock_offset_us = clock_.offset_us();
    if (report_.state == State::kLost) ++report_.reconnects;
  }
  backoff_.reset();
  set_state(State::kStreaming, "");
}

void Capture::count_loss() {
  const std::lock_guard lock(mutex_);
  if (report_.state == State::kStreaming) ++report_.losses;
}

void Capture::account(const OpenNiCamera& camera) {
  const std::lock_guard lock(mutex_);
  report_.depth_unpaired = before_.depth_unpaired + camera.depth_unpaired();
  report_.color_unpaired = before_.color_unpaired + camera.color_unpaired();
  report_.malformed = before_.malformed + camera.malformed();
}

void Capture::close_account(const OpenNiCamera& camera) {
  account(camera);
  const std::lock_guard lock(mutex_);
  before_ = report_;
}

}  // namespace roomwise
