#include "services/landmark_svc/core/region_of_interest.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace roomwise::landmark {
namespace {

PixelRectangle region(const char* name, int drop_bottom_rows_px = 0) {
  RegionParams params;
  params.region = name;
  params.drop_bottom_rows_px = drop_bottom_rows_px;
  return region_of_interest(params, 320, 240);
}

TEST(RegionOfInterest, QuadrantsCoverTheImageOnce) {
  int pixels = 0;
  for (const char* name : {"top_left", "top_right", "bottom_left", "bottom_right"}) {
    pixels += region(name).width_px() * region(name).height_px();
  }
  EXPECT_EQ(pixels, 320 * 240);
  EXPECT_EQ(region("bottom_right").u_begin_px, 160);
  EXPECT_EQ(region("bottom_right").v_begin_px, 120);
}

TEST(RegionOfInterest, DroppedRowsAreAtTheBottomOfTheImage) {
  EXPECT_EQ(region("whole", 40).v_end_px, 200);
  EXPECT_EQ(region("bottom_left", 40).v_end_px, 200);
  EXPECT_EQ(region("top_left", 40).v_end_px, 120);
  EXPECT_TRUE(region("bottom_left", 130).empty());
}

RC_GTEST_PROP(RegionOfInterest, AlwaysLiesInTheImage, ()) {
  RegionParams params;
  params.region = *rc::gen::element<std::string>("whole", "slice", "top_left", "bottom_right");
  params.slice_first_row_px = *rc::gen::inRange(0, 5000);
  params.slice_rows_px = *rc::gen::inRange(1, 5000);
  params.drop_bottom_rows_px = *rc::gen::inRange(0, 5000);
  const int width_px = *rc::gen::inRange(1, 700);
  const int height_px = *rc::gen::inRange(1, 700);
  const PixelRectangle found = region_of_interest(params, width_px, height_px);
  if (found.empty()) return;
  RC_ASSERT(found.u_begin_px >= 0 && found.u_end_px <= width_px);
  RC_ASSERT(found.v_begin_px >= 0 && found.v_end_px <= height_px);
  RC_ASSERT(found.v_end_px <= std::max(0, height_px - params.drop_bottom_rows_px));
}

}  // namespace
}  // namespace roomwise::landmark
