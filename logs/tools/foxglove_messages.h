#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "common/image/rgbd_frame.h"

namespace roomwise {

// Messages by the schemas that Foxglove and Lichtblick know by name
// (docs.foxglove.dev/docs/visualization/message-schemas), as JSON.

struct FoxgloveSchema {
  std::string_view name;
  std::string_view schema;
};
extern const FoxgloveSchema kCompressedImageSchema;
extern const FoxgloveSchema kRawImageSchema;
extern const FoxgloveSchema kCameraCalibrationSchema;
extern const FoxgloveSchema kFrameTransformSchema;

/// foxglove.CompressedImage of a JPEG.
std::string compressed_image_json(std::int64_t utime, std::span<const std::uint8_t> jpeg);

/// foxglove.RawImage, encoding rgb8.
std::string color_image_json(std::int64_t utime, const ColorImage& color);

/// foxglove.RawImage, encoding 16UC1: little-endian millimetres, 0 where there is no reading or it
/// does not fit.
std::string depth_image_json(std::int64_t utime, const DepthImage& depth);

/// foxglove.CameraCalibration without distortion.
std::string calibration_json(std::int64_t utime, const PinholeCamera& camera, int width_px,
                             int height_px);

/// foxglove.FrameTransform: where frame `child` is in frame `parent`.
std::string transform_json(std::int64_t utime, std::string_view parent, std::string_view child,
                           const Eigen::Isometry3d& T_parent_child);

}  // namespace roomwise
