#include "common/frames/frame_encoder.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>

#include "common/image/player_words.h"

namespace roomwise {

static_assert(std::endian::native == std::endian::little, "DEPTH_RAW16 is copied as it lies");

namespace {

void describe_depth(const DepthImage& depth, std::int8_t depth_encoding, kinect_frame_t& message) {
  message.depth_encoding = depth_encoding;
  message.depth_width_px = depth.width_px;
  message.depth_height_px = depth.height_px;
  message.depth_unit_m = depth.unit_m;
  message.depth_size = static_cast<std::int32_t>(message.depth_data.size());
}

void require_size(const DepthImage& depth) {
  const auto sides =
      static_cast<std::size_t>(depth.width_px) * static_cast<std::size_t>(depth.height_px);
  if (depth.steps.empty() || depth.size() != sides) {
    throw std::invalid_argument("depth image: size does not match its values");
  }
}

}  // namespace

void FrameEncoder::encode_depth(const DepthImage& depth, std::int8_t depth_encoding,
                                kinect_frame_t& message) {
  const std::span<const std::uint16_t> steps = depth.steps;
  if (depth_encoding == kinect_frame_t::DEPTH_PDZ16) {
    pdz16_.encode(steps, depth.width_px, depth.height_px, message.depth_data);
  } else if (depth_encoding == kinect_frame_t::DEPTH_RAW16) {
    require_size(depth);
    message.depth_data.resize(steps.size_bytes());
    std::memcpy(message.depth_data.data(), steps.data(), steps.size_bytes());
  } else {
    throw std::invalid_argument("unknown depth encoding " + std::to_string(depth_encoding));
  }
  describe_depth(depth, depth_encoding, message);
}

void FrameEncoder::encode_depth_and_players(const DepthImage& depth,
                                            std::span<const std::uint8_t> players,
                                            kinect_frame_t& message) {
  require_size(depth);
  if (players.size() != depth.size()) {
    throw std::invalid_argument("players: not one for each depth");
  }
  if (std::ranges::max(depth.steps) > kPlayer16DepthMax_steps ||
      std::ranges::max(players) > kPlayer16PlayerMax) {
    throw std::invalid_argument("a depth above 13 bits or a player above 3 bits");
  }
  message.depth_data.resize(2 * depth.size());
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const std::uint16_t word = pack_player16({.depth_steps = depth.steps[i], .player = players[i]});
    std::memcpy(&message.depth_data[2 * i], &word, sizeof word);
  }
  describe_depth(depth, kinect_frame_t::DEPTH_PLAYER16, message);
}

void FrameEncoder::encode_color(const ColorImage& color, std::int8_t color_encoding,
                                int jpeg_quality, kinect_frame_t& message) {
  if (color.empty()) {
    color_encoding = kinect_frame_t::COLOR_NONE;
    message.color_data.clear();
  } else if (color_encoding == kinect_frame_t::COLOR_JPEG) {
    jpeg_.encode(color.rgb, color.width_px, color.height_px, jpeg_quality, message.color_data);
  } else if (color_encoding == kinect_frame_t::COLOR_RGB8) {
    const auto sides =
        static_cast<std::size_t>(color.width_px) * static_cast<std::size_t>(color.height_px);
    if (color.rgb.size() != 3 * sides) {
      throw std::invalid_argument("colour image: size does not match its pixels");
    }
    message.color_data = color.rgb;
  } else {
    throw std::invalid_argument("unknown colour encoding " + std::to_string(color_encoding));
  }
  message.color_encoding = color_encoding;
  message.color_width_px = color.empty() ? 0 : color.width_px;
  message.color_height_px = color.empty() ? 0 : color.height_px;
  message.color_size = static_cast<std::int32_t>(message.color_data.size());
}

void encode_depth_camera(const PinholeCamera& camera, kinect_frame_t& message) {
  message.depth_fx_px = camera.fx_px;
  message.depth_fy_px = camera.fy_px;
  message.depth_cx_px = camera.cx_px;
  message.depth_cy_px = camera.cy_px;
}

void encode_color_camera(const PinholeCamera& camera, kinect_frame_t& message) {
  message.color_fx_px = camera.fx_px;
  message.color_fy_px = camera.fy_px;
  message.color_cx_px = camera.cx_px;
  message.color_cy_px = camera.cy_px;
}

void encode_pose(const Eigen::Isometry3d& T_robot_camera, kinect_frame_t& message) {
  const Eigen::Vector3d& translation_m = T_robot_camera.translation();
  for (int axis = 0; axis < 3; ++axis)
    message.T_robot_camera_translation_m[axis] = translation_m[axis];
  const Eigen::Quaterniond rotation(T_robot_camera.linear());
  message.T_robot_camera_quat[0] = rotation.w();
  message.T_robot_camera_quat[1] = rotation.x();
  message.T_robot_camera_quat[2] = rotation.y();
  message.T_robot_camera_quat[3] = rotation.z();
}

}  // namespace roomwise
