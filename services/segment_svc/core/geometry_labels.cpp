#include "services/segment_svc/core/geometry_labels.h"

#include <cmath>

#include "common/multiversion.h"
#include "services/segment_svc/core/labels.h"

namespace roomwise::segment {
namespace {

/// What a row's loop needs; floats, so that it runs many pixels at a time.
struct HeightRule {
  float unit_m;
  float range_max_m;
  float quantum_per_m;
  float camera_height_m;
  float floor_tolerance_m;
  float drop_off_depth_m;
};

/// A pixel's height is depth * (slope of its column + slope of its row) + camera height.
ROOMWISE_MULTIVERSION
void label_row(const std::uint16_t* steps, const float* slope_of_column, float slope_of_row,
               HeightRule rule, std::size_t width, std::uint8_t* labels) {
  for (std::size_t u = 0; u < width; ++u) {
    const float z_m = rule.unit_m * static_cast<float>(steps[u]);
    const float slope = slope_of_column[u] + slope_of_row;
    const float height_m = z_m * slope + rule.camera_height_m;
    const float sigma_m = z_m * z_m * rule.quantum_per_m * std::abs(slope);
    const float floor_band_m = rule.floor_tolerance_m + sigma_m;
    const float drop_off_m = -(rule.drop_off_depth_m + 3.0F * sigma_m);
    // One choice after another, no two in one condition: so the compiler makes selects of them.
    int label = height_m > 0.0F ? kObstacle : kUnknown;
    label = height_m < drop_off_m ? kDropOff : label;
    label = std::abs(height_m) <= floor_band_m ? kAccessible : label;
    label = z_m <= rule.range_max_m ? label : kUnknown;
    label = steps[u] > 0 ? label : kUnknown;
    labels[u] = static_cast<std::uint8_t>(label);
  }
}

/// `above_wall` is 255 where the rows below have shown a wall.
ROOMWISE_MULTIVERSION
void doubt_row(std::size_t width, std::uint8_t* above_wall, std::uint8_t* labels) {
  for (std::size_t u = 0; u < width; ++u) {
    const int wall = labels[u] == kWall ? 255 : 0;
    above_wall[u] = static_cast<std::uint8_t>(above_wall[u] | wall);
    const int doubt = labels[u] == kAccessible ? above_wall[u] : 0;
    labels[u] = static_cast<std::uint8_t>(labels[u] | doubt);  // kUnknown is 255
  }
}

}  // namespace

void GeometryLabels::label(const RgbdFrame& frame, const CameraView& view, const FloorPlane& floor,
                           std::vector<std::uint8_t>& labels) {
  label_heights(frame, view, floor, labels);
  standing_.mark(frame, view, floor, labels);
  walls_.mark(frame, view, floor, labels);
  doubt_floor_above_walls(view, labels);
}

void GeometryLabels::label_heights(const RgbdFrame& frame, const CameraView& view,
                                   const FloorPlane& floor, std::vector<std::uint8_t>& labels) {
  const auto width = static_cast<std::size_t>(view.width_px());
  const auto height = static_cast<std::size_t>(view.height_px());
  labels.resize(width * height);
  slope_of_column_.resize(width);
  const Eigen::Vector3f n = floor.normal.cast<float>();
  for (std::size_t u = 0; u < width; ++u) slope_of_column_[u] = n.x() * view.ray_x()[u];
  const HeightRule rule{.unit_m = static_cast<float>(view.unit_m()),
                        .range_max_m = static_cast<float>(params_.range_max_m),
                        .quantum_per_m = view.quantum_per_m(),
                        .camera_height_m = static_cast<float>(floor.height_m),
                        .floor_tolerance_m = static_cast<float>(params_.floor_tolerance_m),
                        .drop_off_depth_m = static_cast<float>(params_.drop_off_depth_m)};
  for (std::size_t v = 0; v < height; ++v) {
    label_row(frame.depth.steps.data() + v * width, slope_of_column_.data(),
              n.y() * view.ray_y()[v] + n.z(), rule, width, labels.data() + v * width);
  }
}

void GeometryLabels::doubt_floor_above_walls(const CameraView& view,
                                             std::vector<std::uint8_t>& labels) {
  const auto width = static_cast<std::size_t>(view.width_px());
  above_wall_.assign(width, 0);
  for (auto v = static_cast<std::size_t>(view.height_px()); v-- > 0;) {
    doubt_row(width, above_wall_.data(), labels.data() + v * width);
  }
}

}  // namespace roomwise::segment
