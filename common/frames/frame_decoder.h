#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "common/frames/jpeg.h"
#include "common/image/depth_codec.h"
#include "common/image/rgbd_frame.h"
#include "roomwise/kinect_frame_t.hpp"

namespace roomwise {

enum class FrameResult {
  kOk,
  kBadSize,        ///< width or height not in [16, 4096] (depth) or [1, 4096] (colour)
  kBadDepth,       ///< depth data does not decode to width x height
  kBadDepthUnit,   ///< depth_unit_m not in (0, 0.1]
  kBadColor,       ///< colour data does not decode to width x height
  kBadIntrinsics,  ///< focal length or principal point far outside any real camera's, or not
                   ///< finite
  kBadPose,        ///< quaternion not of unit length, camera more than 100 m off, or not finite
};

/// The name a result is counted under on HEALTH, e.g. "frame_bad_depth".
std::string_view counter_name(FrameResult result);

enum class ColorUse { kDecode, kSkip };

/// Makes frames out of KINECT_FRAME messages. Keeps its buffers, so that after the first frame of
/// a size nothing is allocated but inside the JPEG decoder.
class FrameDecoder {
 public:
  explicit FrameDecoder(ColorUse color_use) : color_use_(color_use) {}

  /// Decodes `message` into `frame`, reusing its memory. On failure `frame` is unspecified.
  /// With kSkip the colour part is not even looked at; then, or if the message has no colour,
  /// frame.color is empty and frame.color_camera all zero. Unless the depth is DEPTH_PLAYER16,
  /// frame.players is empty. The quaternion is normalised.
  FrameResult decode(const kinect_frame_t& message, RgbdFrame& frame);

  /// Decodes the colour part alone, as decode() does; the rest of `frame` stays as it is.
  FrameResult decode_color(const kinect_frame_t& message, RgbdFrame& frame);

 private:
  FrameResult decode_depth(const kinect_frame_t& message, RgbdFrame& frame);
  bool decode_pixels(const kinect_frame_t& message, std::span<std::uint8_t> rgb);

  ColorUse color_use_;
  DepthDecoder pdz16_;
  JpegDecoder jpeg_;
};

}  // namespace roomwise
