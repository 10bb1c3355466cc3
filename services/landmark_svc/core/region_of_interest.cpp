#include "services/landmark_svc/core/region_of_interest.h"

#include <algorithm>

namespace roomwise::landmark {

PixelRectangle region_of_interest(const RegionParams& params, int width_px, int height_px) {
  PixelRectangle region{0, 0, width_px, height_px};
  const std::string& name = params.region;
  if (name.starts_with("top_")) region.v_end_px = height_px / 2;
  if (name.starts_with("bottom_")) region.v_begin_px = height_px / 2;
  if (name.ends_with("_left")) region.u_end_px = width_px / 2;
  if (name.ends_with("_right")) region.u_begin_px = width_px / 2;
  if (name == "slice") {
    region.v_begin_px = std::clamp(params.slice_first_row_px, 0, height_px);
    region.v_end_px =
        region.v_begin_px + std::clamp(params.slice_rows_px, 0, height_px - region.v_begin_px);
  }
  const int last_kept = height_px - std::clamp(params.drop_bottom_rows_px, 0, height_px);
  region.v_end_px = std::min(region.v_end_px, last_kept);
  return region;
}

}  // namespace roomwise::landmark
