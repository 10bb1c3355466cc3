#include "services/segment_svc/core/class_prior.h"

#include <cmath>
#include <limits>

namespace roomwise::segment {
namespace {

/// Shares of obstacle, wall and accessible among the pixels of rows that would see the floor not
/// farther than `depth_max_m`. Counted over 160 views along the ways through the simulator's living
/// room, apartment, crowd and dark room, from a camera 0.4 m high looking 0.1 rad down.
struct Zone {
  float depth_max_m;
  ClassScores share_ratio;
};
constexpr float kAny_m = std::numeric_limits<float>::infinity();
constexpr std::array<Zone, 6> kZones = {{{1.0F, {0.019F, 0.002F, 0.979F}},
                                         {1.5F, {0.074F, 0.033F, 0.893F}},
                                         {2.0F, {0.152F, 0.107F, 0.741F}},
                                         {3.0F, {0.266F, 0.230F, 0.504F}},
                                         {6.0F, {0.417F, 0.399F, 0.184F}},
                                         {kAny_m, {0.500F, 0.484F, 0.016F}}}};
constexpr ClassScores kJustAboveHorizon = {0.455F, 0.545F, 1e-4F};
constexpr ClassScores kAbove = {0.305F, 0.695F, 1e-4F};
constexpr float kAboveSlope = 0.1F;

/// The same views: what geometry called them, of the pixels of each class.
constexpr ClassScores kCalledObstacle = {0.604F, 0.175F, 0.0009F};
constexpr ClassScores kCalledWall = {0.306F, 0.671F, 0.0006F};
constexpr ClassScores kCalledAccessible = {0.0019F, 0.0003F, 0.951F};
constexpr ClassScores kCalledUnknown = {0.089F, 0.154F, 0.047F};

ClassScores logarithms(const ClassScores& ratio) {
  return {std::log(ratio[0]), std::log(ratio[1]), std::log(ratio[2])};
}

float slope_of_row(const CameraView& view, const FloorPlane& floor, int row_px) {
  const Eigen::Vector3f n = floor.normal.cast<float>();
  return n.y() * view.ray_y()[static_cast<std::size_t>(row_px)] + n.z();
}

}  // namespace

float floor_depth_m(const CameraView& view, const FloorPlane& floor, int row_px) {
  const float slope = slope_of_row(view, floor, row_px);
  return slope < 0.0F ? static_cast<float>(floor.height_m) / -slope : kAny_m;
}

ClassScores log_location_prior(const CameraView& view, const FloorPlane& floor, int row_px) {
  const float slope = slope_of_row(view, floor, row_px);
  if (!(slope < 0.0F)) return logarithms(slope > kAboveSlope ? kAbove : kJustAboveHorizon);
  const float depth_m = floor_depth_m(view, floor, row_px);
  const auto* zone = std::find_if(kZones.begin(), kZones.end() - 1,
                                  [&](const Zone& z) { return depth_m <= z.depth_max_m; });
  return logarithms(zone->share_ratio);
}

ClassScores log_geometry_says(Label label) {
  switch (label) {
    case kObstacle:
      return logarithms(kCalledObstacle);
    case kWall:
      return logarithms(kCalledWall);
    case kAccessible:
      return logarithms(kCalledAccessible);
    case kUnknown:
      return logarithms(kCalledUnknown);
    case kDropOff:
      break;
  }
  return {};
}

}  // namespace roomwise::segment
