#pragma once
#include <string>

namespace roomwise::landmark {

/// Columns [u_begin, u_end) and rows [v_begin, v_end) of an image; empty where begin >= end.
struct PixelRectangle {
  int u_begin_px = 0;
  int v_begin_px = 0;
  int u_end_px = 0;
  int v_end_px = 0;

  int width_px() const { return u_end_px > u_begin_px ? u_end_px - u_begin_px : 0; }
  int height_px() const { return v_end_px > v_begin_px ? v_end_px - v_begin_px : 0; }
  bool empty() const { return width_px() == 0 || height_px() == 0; }
};

/// Which part of the depth image is looked at. Pixels outside count as not seen.
struct RegionParams {
  /// "whole", "slice", or a quadrant: "top_left", "top_right", "bottom_left", "bottom_right".
  std::string region = "whole";
  int slice_first_row_px = 0;   ///< region "slice": its top row
  int slice_rows_px = 1;        ///< region "slice": how many rows
  int drop_bottom_rows_px = 0;  ///< rows left out at the bottom of the image, whatever the region
};

/// The rectangle `params` names in an image of this size, inside the image, perhaps empty.
PixelRectangle region_of_interest(const RegionParams& params, int width_px, int height_px);

}  // namespace roomwise::landmark
