#include "services/simulator/core/kinect/projector_shadow.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

namespace roomwise::simulator {
namespace {

constexpr int kRow_px = 640;

/// A row of disparities in pixels: `far` everywhere but for `near` in [begin, end).
std::vector<float> row_with_object(float far_px, float near_px, int begin, int end) {
  std::vector<float> row(kRow_px, far_px);
  std::fill(row.begin() + begin, row.begin() + end, near_px);
  return row;
}

std::vector<float> shadowed(std::vector<float> row) {
  ProjectorShadow shadow;
  shadow.resize(kRow_px);
  shadow.apply(row, 1.0F);
  return row;
}

int dark_between(const std::vector<float>& row, int begin, int end) {
  return static_cast<int>(std::count(row.begin() + begin, row.begin() + end, 0.0F));
}

RC_GTEST_PROP(ProjectorShadow, LiesLeftOfNearThingsAndIsAsWideAsTheDisparitiesDiffer, ()) {
  const float far_px = static_cast<float>(*rc::gen::inRange(50, 200)) / 10.0F;
  const float step_px = static_cast<float>(*rc::gen::inRange(20, 600)) / 10.0F;
  const int begin = *rc::gen::inRange(150, 300);
  const int end = begin + *rc::gen::inRange(70, 200);
  const std::vector<float> row = shadowed(row_with_object(far_px, far_px + step_px, begin, end));
  RC_ASSERT(std::abs(static_cast<float>(dark_between(row, 0, begin)) - step_px) <= 1.0F);
  RC_ASSERT(row[static_cast<std::size_t>(begin - 1)] == 0.0F);
  RC_ASSERT(dark_between(row, begin, kRow_px) == 0);
}

RC_GTEST_PROP(ProjectorShadow, OfAThinThingIsNoWiderThanTheThingAndLiesApart, ()) {
  const int width_px = *rc::gen::inRange(3, 15);
  const int step_px = *rc::gen::inRange(20, 60);
  const auto near_px = static_cast<float>(10 + step_px);
  const std::vector<float> row = shadowed(row_with_object(10.0F, near_px, 300, 300 + width_px));
  RC_ASSERT(std::abs(dark_between(row, 0, kRow_px) - width_px) <= 1);
  RC_ASSERT(std::abs(dark_between(row, 300 - step_px, 300 - step_px + width_px) - width_px) <= 1);
}

RC_GTEST_PROP(ProjectorShadow, NoneOnASurfaceTheProjectorSeesAllOf, ()) {
  const float slope = static_cast<float>(*rc::gen::inRange(-200, 95)) / 100.0F;
  std::vector<float> row(kRow_px);
  for (int u = 0; u < kRow_px; ++u) {
    row[static_cast<std::size_t>(u)] = std::max(2.0F, 80.0F + slope * static_cast<float>(u - 320));
  }
  RC_ASSERT(shadowed(row) == row);
}

TEST(ProjectorShadow, HolesNeitherCastNorTakeIt) {
  std::vector<float> row = row_with_object(10.0F, 40.0F, 300, 400);
  std::fill(row.begin() + 280, row.begin() + 300, 0.0F);
  const std::vector<float> lit = shadowed(row);
  EXPECT_NEAR(dark_between(lit, 0, 300), 30, 1);
  EXPECT_EQ(dark_between(lit, 300, kRow_px), 0);
  const std::vector<float> empty(kRow_px, 0.0F);
  EXPECT_EQ(shadowed(empty), empty);
}

TEST(ProjectorShadow, DisparitiesBeyondAllReasonStayInTheRow) {
  const std::vector<float> row = shadowed(row_with_object(5.0F, 1e6F, 100, 200));
  EXPECT_EQ(row[150], 1e6F);
  EXPECT_EQ(row[300], 5.0F);
}

}  // namespace
}  // namespace roomwise::simulator
