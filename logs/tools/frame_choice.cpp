#include "logs/tools/frame_choice.h"

#include <algorithm>
#include <iterator>
#include <vector>

namespace roomwise {

std::int64_t choose_seq(const std::set<std::int64_t>& frames, const std::set<std::int64_t>& answers,
                        std::optional<std::int64_t> wanted) {
  std::vector<std::int64_t> both;
  std::ranges::set_intersection(frames, answers, std::back_inserter(both));
  if (both.empty()) throw std::runtime_error("no frame is answered");
  if (!wanted) return both[both.size() / 2];
  const std::int64_t seq = *wanted + 1;
  if (!std::ranges::binary_search(both, seq)) {
    throw std::runtime_error(fmt::format("frame {} is not answered", *wanted));
  }
  return seq;
}

RgbdFrame decode_colored(const kinect_frame_t& message) {
  FrameDecoder decoder(ColorUse::kDecode);
  RgbdFrame frame;
  const FrameResult result = decoder.decode(message, frame);
  if (result != FrameResult::kOk) throw std::runtime_error(std::string(counter_name(result)));
  if (frame.color.empty()) throw std::runtime_error("frame without colour");
  return frame;
}

}  // namespace roomwise
