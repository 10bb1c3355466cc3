#pragma once
#include <fmt/core.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <stdexcept>

#include "common/frames/frame_decoder.h"
#include "logs/tools/log_replay.h"

namespace roomwise {

/// A camera frame and what a service made of it.
template <class Message>
struct FrameWith {
  RgbdFrame frame;
  Message message;
  LogReading reading;
};

/// Finds frame number `wanted` (KINECT_FRAME.seq - 1; none: the middle one of those that will do)
/// in a log, and the message on `channel` that came of it. Throws std::runtime_error naming the log
/// if there is no such frame or message, or the frame has no colour.
template <class Message>
FrameWith<Message> choose_frame(const std::filesystem::path& log, const Channel<Message>& channel,
                                std::optional<std::int64_t> wanted);

/// Of frames with both a KINECT_FRAME and an answer, the sequence number wanted, or the middle one.
/// Throws std::runtime_error("... frame N") if there is none.
std::int64_t choose_seq(const std::set<std::int64_t>& frames, const std::set<std::int64_t>& answers,
                        std::optional<std::int64_t> wanted);

/// Decodes with colour; throws std::runtime_error with the reason if that fails.
RgbdFrame decode_colored(const kinect_frame_t& message);

template <class Message>
FrameWith<Message> choose_frame(const std::filesystem::path& log, const Channel<Message>& channel,
                                std::optional<std::int64_t> wanted) {
  std::set<std::int64_t> frames;
  std::set<std::int64_t> answers;
  static_cast<void>(replay_log(log, [&](Bus& bus) {
    bus.subscribe(channels::kKinectFrame, [&](const kinect_frame_t& m) { frames.insert(m.seq); });
    bus.subscribe(channel, [&](const Message& m) { answers.insert(m.frame_seq); });
  }));
  try {
    const std::int64_t seq = choose_seq(frames, answers, wanted);
    FrameWith<Message> found;
    found.reading = replay_log(log, [&](Bus& bus) {
      bus.subscribe(channels::kKinectFrame, [&](const kinect_frame_t& m) {
        if (m.seq == seq) found.frame = decode_colored(m);
      });
      bus.subscribe(channel, [&](const Message& m) {
        if (m.frame_seq == seq) found.message = m;
      });
    });
    return found;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {} on {}", log.string(), error.what(), channel.name));
  }
}

}  // namespace roomwise
