#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "roomwise/kinect_frame_t.hpp"

namespace roomwise {

enum class [[nodiscard]] FrameResult{
    kOk,
    kBadSize,        ///< width or height not in [16, 4096] (depth) or [1, 4096] (colour)
    kBadDepth,       ///< depth data does not decode to width x height
    kBadColor,       ///< colour data does not decode to width x height
    kBadIntrinsics,  ///< focal length not positive, or a number not finite
    kBadPose,        ///< quaternion not of unit length, or a number not finite
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
  /// With kSkip, or if the message has none, frame.color is empty.
  FrameResult decode(const kinect_frame_t& message, RgbdFrame& frame);

 private:
  FrameResult decode_color(const kinect_frame_t& message, ColorImage& color);

  ColorUse color_use_;
};

/// Fills the depth part of `message` from `depth` with this encoding (kinect_frame_t::DEPTH_*).
void encode_depth(const DepthImage& depth, std::int8_t encoding, kinect_frame_t& message);

/// Fills the pose part of `message`.
void encode_pose(const Eigen::Isometry3d& T_robot_camera, kinect_frame_t& message);

}  // namespace roomwise
