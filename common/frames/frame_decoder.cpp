#include "common/frames/frame_decoder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <ranges>

#include "common/image/player_words.h"

namespace roomwise {
namespace {

static_assert(std::endian::native == std::endian::little, "DEPTH_RAW16 is copied as it lies");

constexpr int kDepthSideMin_px = 16;
constexpr int kColorSideMin_px = 1;
constexpr double kDepthUnitMax_m = 0.1;
constexpr double kFocalMax_px = 1e5;
constexpr double kTranslationMax_m = 100.0;
constexpr double kQuaternionLengthTolerance = 1e-3;

bool sides_in_range(int width_px, int height_px, int smallest_px) {
  return std::min(width_px, height_px) >= smallest_px &&
         std::max(width_px, height_px) <= kImageSideMax_px;
}

std::size_t pixels(int width_px, int height_px) {
  return static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
}

// Comparisons are written so that NaN fails them.
bool is_focal_length(double f_px) { return f_px >= 1.0 && f_px <= kFocalMax_px; }

// A cropped image's centre may lie outside it, but not by more than its size.
bool is_centre(double c_px, int side_px) { return c_px >= -side_px && c_px <= 2.0 * side_px; }

bool is_camera(const PinholeCamera& camera, int width_px, int height_px) {
  return is_focal_length(camera.fx_px) && is_focal_length(camera.fy_px) &&
         is_centre(camera.cx_px, width_px) && is_centre(camera.cy_px, height_px);
}

// `bytes` are two for each of the image's pixels.
void split_depth_and_players(std::span<const std::uint8_t> bytes, RgbdFrame& frame) {
  std::vector<std::uint16_t>& steps = frame.depth.steps;
  steps.resize(bytes.size() / sizeof(std::uint16_t));
  std::memcpy(steps.data(), bytes.data(), bytes.size());
  frame.players.resize(steps.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const DepthAndPlayer pixel = unpack_player16(steps[i]);
    steps[i] = pixel.depth_steps;
    frame.players[i] = pixel.player;
  }
}

FrameResult decode_pose(const kinect_frame_t& message, Eigen::Isometry3d& T_robot_camera) {
  const auto is_near = [](double m) { return std::abs(m) <= kTranslationMax_m; };
  if (!std::ranges::all_of(message.T_robot_camera_translation_m, is_near)) {
    return FrameResult::kBadPose;
  }
  const auto* wxyz = message.T_robot_camera_quat;
  const Eigen::Quaterniond rotation(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  if (!(std::abs(rotation.norm() - 1.0) <= kQuaternionLengthTolerance))
    return FrameResult::kBadPose;
  T_robot_camera.linear() = rotation.normalized().toRotationMatrix();
  T_robot_camera.translation() = Eigen::Vector3d(message.T_robot_camera_translation_m);
  return FrameResult::kOk;
}

}  // namespace

std::string_view counter_name(FrameResult result) {
  switch (result) {
    case FrameResult::kOk:
      return "frame_ok";
    case FrameResult::kBadSize:
      return "frame_bad_size";
    case FrameResult::kBadDepth:
      return "frame_bad_depth";
    case FrameResult::kBadDepthUnit:
      return "frame_bad_depth_unit";
    case FrameResult::kBadColor:
      return "frame_bad_color";
    case FrameResult::kBadIntrinsics:
      return "frame_bad_intrinsics";
    case FrameResult::kBadPose:
      return "frame_bad_pose";
  }
  return "frame_bad";
}

FrameResult FrameDecoder::decode(const kinect_frame_t& message, RgbdFrame& frame) {
  frame.utime = message.utime;
  frame.seq = message.seq;
  frame.depth_registered = message.depth_registered != 0;
  frame.depth_camera = {message.depth_fx_px, message.depth_fy_px, message.depth_cx_px,
                        message.depth_cy_px};
  if (!sides_in_range(message.depth_width_px, message.depth_height_px, kDepthSideMin_px)) {
    return FrameResult::kBadSize;
  }
  if (!is_camera(frame.depth_camera, message.depth_width_px, message.depth_height_px)) {
    return FrameResult::kBadIntrinsics;
  }
  if (const auto pose = decode_pose(message, frame.T_robot_camera); pose != FrameResult::kOk) {
    return pose;
  }
  if (const auto depth = decode_depth(message, frame); depth != FrameResult::kOk) {
    return depth;
  }
  return decode_color(message, frame);
}

FrameResult FrameDecoder::decode_depth(const kinect_frame_t& message, RgbdFrame& frame) {
  DepthImage& depth = frame.depth;
  frame.players.clear();
  if (!(message.depth_unit_m > 0.0 && message.depth_unit_m <= kDepthUnitMax_m)) {
    return FrameResult::kBadDepthUnit;
  }
  depth.unit_m = message.depth_unit_m;
  depth.width_px = message.depth_width_px;
  depth.height_px = message.depth_height_px;
  const std::vector<std::uint8_t>& bytes = message.depth_data;
  const std::size_t count = pixels(depth.width_px, depth.height_px);
  const std::size_t raw_size = count * sizeof(std::uint16_t);
  if (message.depth_encoding == kinect_frame_t::DEPTH_RAW16 && bytes.size() == raw_size) {
    depth.steps.resize(count);
    std::memcpy(depth.steps.data(), bytes.data(), raw_size);
    return FrameResult::kOk;
  }
  if (message.depth_encoding == kinect_frame_t::DEPTH_PLAYER16 && bytes.size() == raw_size) {
    split_depth_and_players(bytes, frame);
    return FrameResult::kOk;
  }
  if (message.depth_encoding != kinect_frame_t::DEPTH_PDZ16) return FrameResult::kBadDepth;
  depth.steps.resize(count);
  return pdz16_.decode(bytes, depth.width_px, depth.height_px, depth.steps)
             ? FrameResult::kOk
             : FrameResult::kBadDepth;
}

FrameResult FrameDecoder::decode_color(const kinect_frame_t& message, RgbdFrame& frame) {
  if (color_use_ == ColorUse::kSkip || message.color_encoding == kinect_frame_t::COLOR_NONE) {
    frame.color.width_px = frame.color.height_px = 0;
    frame.color.rgb.clear();
    frame.color_camera = {};
    return FrameResult::kOk;
  }
  if (!sides_in_range(message.color_width_px, message.color_height_px, kColorSideMin_px)) {
    return FrameResult::kBadSize;
  }
  frame.color_camera = {message.color_fx_px, message.color_fy_px, message.color_cx_px,
                        message.color_cy_px};
  if (!is_camera(frame.color_camera, message.color_width_px, message.color_height_px)) {
    return FrameResult::kBadIntrinsics;
  }
  frame.color.width_px = message.color_width_px;
  frame.color.height_px = message.color_height_px;
  frame.color.rgb.resize(3 * pixels(frame.color.width_px, frame.color.height_px));
  return decode_pixels(message, frame.color.rgb) ? FrameResult::kOk : FrameResult::kBadColor;
}

bool FrameDecoder::decode_pixels(const kinect_frame_t& message, std::span<std::uint8_t> rgb) {
  const std::vector<std::uint8_t>& bytes = message.color_data;
  if (message.color_encoding == kinect_frame_t::COLOR_RGB8 && bytes.size() == rgb.size()) {
    std::ranges::copy(bytes, rgb.begin());
    return true;
  }
  return message.color_encoding == kinect_frame_t::COLOR_JPEG &&
         jpeg_.decode(bytes, message.color_width_px, message.color_height_px, rgb);
}

}  // namespace roomwise
