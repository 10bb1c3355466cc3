#include "services/kinect_pub/core/shift_depth.h"

namespace roomwise::kinect {

ShiftTable shift_table(const ZeroPlane& plane) {
  ShiftTable table{};
  for (std::size_t word = 0; word < kNoShift; ++word) {
    const double shift =
        (static_cast<double>(word) / 4.0 - plane.shift_offset - 0.375) * plane.pixel_size;
    const double room = plane.baseline - shift;
    const double depth_mm = 10.0 * plane.distance * plane.baseline / room;
    if (room > 0.0 && depth_mm >= 1.0 && depth_mm <= kShiftMax_mm) {
      table[word] = static_cast<std::uint16_t>(depth_mm);
    }
  }
  return table;
}

void shifts_to_depths(const ShiftTable& table, std::span<std::uint16_t> words) {
  for (std::uint16_t& word : words) word = table[word & 2047U];
}

}  // namespace roomwise::kinect
