#pragma once
#include <cstdint>
#include <span>

#include "common/frames/jpeg.h"
#include "common/image/depth_codec.h"
#include "common/image/rgbd_frame.h"
#include "roomwise/kinect_frame_t.hpp"

namespace roomwise {

/// Fills parts of KINECT_FRAME messages. Keeps its buffers.
class FrameEncoder {
 public:
  /// Fills the depth part but for the intrinsics: `depth_encoding` is kinect_frame_t::DEPTH_RAW16
  /// or DEPTH_PDZ16. Throws std::invalid_argument for another encoding, a side not in [1, 4096] or
  /// steps that are not height x width.
  void encode_depth(const DepthImage& depth, std::int8_t depth_encoding, kinect_frame_t& message);

  /// Fills the depth part but for the intrinsics as DEPTH_PLAYER16: `players` is height x width, 0
  /// nobody. Throws std::invalid_argument for sizes as encode_depth, and for a depth above 8191
  /// steps or a player above 7: they have no place in a word, and nothing is cut off in silence.
  void encode_depth_and_players(const DepthImage& depth, std::span<const std::uint8_t> players,
                                kinect_frame_t& message);

  /// Fills the colour part but for the intrinsics: `color_encoding` is COLOR_RGB8 or COLOR_JPEG
  /// (of `jpeg_quality`); an empty image becomes COLOR_NONE. Throws as encode_depth.
  void encode_color(const ColorImage& color, std::int8_t color_encoding, int jpeg_quality,
                    kinect_frame_t& message);

 private:
  DepthEncoder pdz16_;
  JpegEncoder jpeg_;
};

/// Fills the depth camera's intrinsics, in `message`.
void encode_depth_camera(const PinholeCamera& camera, kinect_frame_t& message);

/// Fills the colour camera's intrinsics, in `message`.
void encode_color_camera(const PinholeCamera& camera, kinect_frame_t& message);

/// Fills the pose part of `message`.
void encode_pose(const Eigen::Isometry3d& T_robot_camera, kinect_frame_t& message);

}  // namespace roomwise
