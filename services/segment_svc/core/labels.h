#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace roomwise::segment {

/// What a pixel is, for a robot that wants to drive. Values are those of segmentation_t.LABEL_*.
enum Label : std::uint8_t {
  kObstacle = 0,
  kDropOff = 50,
  kWall = 100,
  kAccessible = 200,
  kUnknown = 255,  ///< unknown is never free
};

/// All labels in ascending order.
inline constexpr std::array<Label, 5> kLabels = {kObstacle, kDropOff, kWall, kAccessible, kUnknown};

/// What a person teaches with rectangles (thesis, section 4.3), in ascending order of label.
inline constexpr std::array<Label, 3> kTrainedClasses = {kObstacle, kWall, kAccessible};
inline constexpr std::size_t kTrainedClassCount = kTrainedClasses.size();

}  // namespace roomwise::segment
