#include "logs/tools/foxglove_messages.h"

#include <algorithm>
#include <cmath>

#include "logs/tools/json_fields.h"

namespace roomwise {
namespace {

#define ROOMWISE_TIME_SCHEMA \
  R"("timestamp":{"type":"object","properties":{"sec":{"type":"integer"},"nsec":{"type":"integer"}}})"
#define ROOMWISE_NUMBERS_SCHEMA R"({"type":"array","items":{"type":"number"}})"
#define ROOMWISE_BYTES_SCHEMA R"({"type":"string","contentEncoding":"base64"})"

std::string timestamp(std::int64_t utime) {
  const std::int64_t time_us = std::max<std::int64_t>(utime, 0);
  return fmt::format(R"("timestamp":{{"sec":{},"nsec":{}}})", time_us / 1'000'000,
                     time_us % 1'000'000 * 1000);
}

std::string raw_image(std::int64_t utime, int width_px, int height_px, std::string_view encoding,
                      int pixel_bytes, std::span<const std::uint8_t> data) {
  return fmt::format(
      R"({{{},"frame_id":"camera","width":{},"height":{},"encoding":"{}","step":{},"data":"{}"}})",
      timestamp(utime), width_px, height_px, encoding, width_px * pixel_bytes, base64(data));
}

}  // namespace

constexpr FoxgloveSchema kCompressedImageSchema{
    "foxglove.CompressedImage", R"({"type":"object","properties":{)" ROOMWISE_TIME_SCHEMA
                                R"(,"frame_id":{"type":"string"},"data":)" ROOMWISE_BYTES_SCHEMA
                                R"(,"format":{"type":"string"}}})"};
constexpr FoxgloveSchema kRawImageSchema{
    "foxglove.RawImage",
    R"({"type":"object","properties":{)" ROOMWISE_TIME_SCHEMA
    R"(,"frame_id":{"type":"string"},"width":{"type":"integer"},"height":{"type":"integer"},)"
    R"("encoding":{"type":"string"},"step":{"type":"integer"},"data":)" ROOMWISE_BYTES_SCHEMA
    R"(}})"};
constexpr FoxgloveSchema kCameraCalibrationSchema{
    "foxglove.CameraCalibration",
    R"({"type":"object","properties":{)" ROOMWISE_TIME_SCHEMA
    R"(,"frame_id":{"type":"string"},"width":{"type":"integer"},"height":{"type":"integer"},)"
    R"("distortion_model":{"type":"string"},"D":)" ROOMWISE_NUMBERS_SCHEMA
    R"(,"K":)" ROOMWISE_NUMBERS_SCHEMA R"(,"R":)" ROOMWISE_NUMBERS_SCHEMA
    R"(,"P":)" ROOMWISE_NUMBERS_SCHEMA R"(}})"};
constexpr FoxgloveSchema kFrameTransformSchema{
    "foxglove.FrameTransform",
    R"({"type":"object","properties":{)" ROOMWISE_TIME_SCHEMA
    R"(,"parent_frame_id":{"type":"string"},"child_frame_id":{"type":"string"},)"
    R"("translation":{"type":"object","properties":{"x":{"type":"number"},)"
    R"("y":{"type":"number"},"z":{"type":"number"}}},)"
    R"("rotation":{"type":"object","properties":{"x":{"type":"number"},"y":{"type":"number"},)"
    R"("z":{"type":"number"},"w":{"type":"number"}}}}})"};

std::string compressed_image_json(std::int64_t utime, std::span<const std::uint8_t> jpeg) {
  return fmt::format(R"({{{},"frame_id":"camera","data":"{}","format":"jpeg"}})", timestamp(utime),
                     base64(jpeg));
}

std::string color_image_json(std::int64_t utime, const ColorImage& color) {
  return raw_image(utime, color.width_px, color.height_px, "rgb8", 3, color.rgb);
}

std::string depth_image_json(std::int64_t utime, const DepthImage& depth) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(2 * depth.size());
  for (const std::uint16_t step : depth.steps) {
    const double depth_mm = 1000.0 * step * depth.unit_m;
    const auto word = depth_mm < 65535.5 ? static_cast<unsigned>(std::lround(depth_mm)) : 0U;
    bytes.push_back(static_cast<std::uint8_t>(word & 0xffU));
    bytes.push_back(static_cast<std::uint8_t>(word >> 8U & 0xffU));
  }
  return raw_image(utime, depth.width_px, depth.height_px, "16UC1", 2, bytes);
}

std::string calibration_json(std::int64_t utime, const PinholeCamera& camera, int width_px,
                             int height_px) {
  const auto& c = camera;
  return fmt::format(
      R"({{{},"frame_id":"camera","width":{},"height":{},"distortion_model":"","D":[],)"
      R"("K":[{},0,{},0,{},{},0,0,1],"R":[1,0,0,0,1,0,0,0,1],"P":[{},0,{},0,0,{},{},0,0,0,1,0]}})",
      timestamp(utime), width_px, height_px, c.fx_px, c.cx_px, c.fy_px, c.cy_px, c.fx_px, c.cx_px,
      c.fy_px, c.cy_px);
}

std::string transform_json(std::int64_t utime, std::string_view parent, std::string_view child,
                           const Eigen::Isometry3d& T_parent_child) {
  const Eigen::Vector3d p = T_parent_child.translation();
  const Eigen::Quaterniond q(T_parent_child.linear());
  return fmt::format(
      R"({{{},"parent_frame_id":"{}","child_frame_id":"{}",)"
      R"("translation":{{"x":{},"y":{},"z":{}}},"rotation":{{"x":{},"y":{},"z":{},"w":{}}}}})",
      timestamp(utime), parent, child, p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w());
}

}  // namespace roomwise
