#include "services/landmark_svc/core/scan_lines.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tests/landmark_svc/support/plan_scan.h"

namespace roomwise::landmark {
namespace {

ScanLines lines_of(const VirtualScan& scan) {
  ScanLines lines;
  lines.prepare(scan, plan_table());
  return lines;
}

RC_GTEST_PROP(ScanLines, AnyUprightPlaneIsALine, ()) {
  const double turned_rad = 0.001 * *rc::gen::inRange(-1000, 1000);
  const double away_m = 0.001 * *rc::gen::inRange(1000, 3000);
  const VirtualScan scan = scan_of_plan(
      [&](double x) { return line_at(x, std::sin(turned_rad), std::cos(turned_rad), away_m); }, 0.0,
      1);
  const ScanLines lines = lines_of(scan);
  RC_PRE(scan.points().size() > 20u);
  const ScanLine line = lines.line(0, scan.points().size());
  RC_ASSERT(line.rms_quanta < 0.35);  // rounding: 1 / sqrt(12)
  const double tilt_rad = std::atan2(line.normal().y(), line.normal().x());
  RC_ASSERT(std::abs(tilt_rad - turned_rad) < 0.05);
  for (std::size_t i = 0; i < scan.points().size(); ++i) {
    const double quantum_m = lines.p_m(i).x() * lines.p_m(i).x() / kPlanQuanta_m;
    const double most_m = 1.2 * quantum_m * std::hypot(1.0, lines.p_m(i).y() / lines.p_m(i).x());
    RC_ASSERT(std::abs(line.distance_m(lines.p_m(i), kPlanQuanta_m)) < most_m);
  }
}

TEST(ScanLines, NoiseIsTheSameAtEveryDistance) {
  for (const double away_m : {1.0, 2.0, 3.5}) {
    const ScanLines lines = lines_of(scan_of_plan([&](double) { return away_m; }, 0.6, 3));
    const ScanLine line = lines.line(0, kPlanWidth_px);
    EXPECT_GT(line.rms_quanta, 0.03) << away_m;
    EXPECT_LT(line.rms_quanta, 0.2) << away_m;
  }
}

TEST(ScanLines, ReachEndsAtAStepAndAtTheLength) {
  const ScanLines lines =
      lines_of(scan_of_plan([](double x) { return x > 0.1 ? 1.5 : 2.0; }, 0.0, 1));
  const std::size_t at = 200;  // right of the middle: the far part
  const std::size_t left = lines.reach(at, -1, 5.0, at);
  EXPECT_NEAR(lines.p_m(left).y() / lines.p_m(left).x(), 0.1, 0.004);
  EXPECT_EQ(lines.reach(at, 1, 5.0, at), static_cast<std::size_t>(kPlanWidth_px - 1));
  const std::size_t near = lines.reach(at, 1, 0.2, at);
  EXPECT_NEAR((lines.p_m(near) - lines.p_m(at)).norm(), 0.2, 0.01);
}

TEST(ScanLines, WhereItIsLookedForFromDoesNotChangeWhatIsReached) {
  const ScanLines lines =
      lines_of(scan_of_plan([](double x) { return x > 0.1 ? 1.5 : 2.0; }, 0.0, 1));
  const std::size_t at = 200;
  for (const int step : {-1, 1}) {
    const std::size_t end = lines.reach(at, step, 0.2, at);
    for (std::size_t about = 0; about < kPlanWidth_px + 5; about += 3) {
      EXPECT_EQ(lines.reach(at, step, 0.2, about), end) << about;
    }
  }
}

TEST(ScanLines, ACircleFitsACircleAndNotACorner) {
  const auto round =
      lines_of(scan_of_plan([](double x) { return circle_at(x, 0.0, 2.0, 0.2); }, 0.3, 5));
  const auto corner = lines_of(scan_of_plan(
      [](double x) { return std::max(line_at(x, 1.0, 1.0, 1.8), line_at(x, -1.0, 1.0, 1.8)); }, 0.3,
      5));
  EXPECT_LT(circle_rms_m(round, 8, 40), 0.005);
  EXPECT_GT(circle_rms_m(corner, 130, 190), 0.01);
}

}  // namespace
}  // namespace roomwise::landmark
