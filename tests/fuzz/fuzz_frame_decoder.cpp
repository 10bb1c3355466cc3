// FrameDecoder on KINECT_FRAME messages as they come off the wire.
#include <algorithm>
#include <span>
#include <vector>

#include "common/bus/wire.h"
#include "common/frames/frame_decoder.h"
#include "roomwise/kinect_frame_t_guard.hpp"
#include "tests/fuzz/fingerprint.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::uint8_t> bytes(data, data + size);
  set_fingerprint<roomwise::kinect_frame_t>(bytes);
  roomwise::kinect_frame_t message;
  if (roomwise::decode<roomwise::kinect_frame_t>(bytes, message) != roomwise::DecodeResult::kOk) {
    return 0;
  }
  static roomwise::FrameDecoder decoder(roomwise::ColorUse::kDecode);
  static roomwise::RgbdFrame frame;
  if (decoder.decode(message, frame) != roomwise::FrameResult::kOk) return 0;
  const auto pixels = [](int width_px, int height_px) {
    return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
  };
  if (frame.depth.size() != pixels(frame.depth.width_px, frame.depth.height_px) ||
      (!frame.players.empty() && frame.players.size() != frame.depth.size()) ||
      frame.color.rgb.size() != 3 * pixels(frame.color.width_px, frame.color.height_px) ||
      !frame.T_robot_camera.matrix().allFinite()) {
    __builtin_trap();
  }
  return 0;
}
