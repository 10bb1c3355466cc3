#pragma once
#include <array>
#include <cstdint>
#include <span>

namespace roomwise::kinect {

/// Geometry of a Kinect v1's reference image, in the units in which the device states it: the depth
/// of the reference plane and the size of a pixel on it in one unit, projector to camera likewise.
struct ZeroPlane {
  double distance = 120.0;      ///< [cm]
  double pixel_size = 0.1042;   ///< [cm]
  double baseline = 7.5;        ///< [cm]
  double shift_offset = 200.0;  ///< disparity of the reference plane [px]
};

/// Depth [mm] of each 11-bit disparity word, 0 where there is none.
using ShiftTable = std::array<std::uint16_t, 2048>;

inline constexpr std::uint16_t kNoShift = 2047;       ///< the word for "no reading"
inline constexpr std::uint16_t kShiftMax_mm = 10000;  ///< beyond it depth means nothing

/// With s = (word / 4 - shift_offset - 3/8) pixel_size, the shift against the reference image
/// (words are quarter pixels), similar triangles over the baseline b give
///   depth = distance b / (b - s).
/// A word whose ray never meets (s >= b), or meets beyond kShiftMax_mm, has no depth.
ShiftTable shift_table(const ZeroPlane& plane);

/// Replaces disparity words by depths. Bits above the 11th are ignored.
void shifts_to_depths(const ShiftTable& table, std::span<std::uint16_t> words);

}  // namespace roomwise::kinect
