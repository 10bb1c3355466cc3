#include "tests/landmark_svc/support/plan_scan.h"

#include <cmath>
#include <limits>
#include <random>

namespace roomwise::landmark {
namespace {

constexpr int kHeight_px = 240;
constexpr double kFarthest_m = 4.0;
constexpr double kNothing = std::numeric_limits<double>::infinity();

std::uint16_t measured_mm(double z_m, double error_quanta) {
  if (!(z_m < kFarthest_m)) return 0;
  const double quanta = std::round(kPlanQuanta_m / z_m + error_quanta);
  return static_cast<std::uint16_t>(std::lround(1000.0 * kPlanQuanta_m / quanta));
}

}  // namespace

DisparityTable plan_table() {
  DisparityTable table;
  table.prepare(0.001, kPlanQuanta_m);
  return table;
}

FloorView plan_floor() { return {Eigen::Vector3d::UnitY(), kPlanCameraHeight_m, 0}; }

VirtualScan scan_of_plan(const std::function<double(double)>& along_m, double noise_quanta,
                         std::uint32_t seed) {
  DepthImage depth{kPlanWidth_px, kHeight_px, 0.001, {}};
  std::minstd_rand random(seed + 1);
  std::normal_distribution<double> noise(0.0, 1.0);
  for (int v = 0; v < kHeight_px; ++v) {
    for (int u = 0; u < kPlanWidth_px; ++u) {
      const double x = -(u - kPlanCamera.cx_px) / kPlanCamera.fx_px;
      depth.steps.push_back(measured_mm(along_m(x), noise_quanta * noise(random)));
    }
  }
  Eigen::Isometry3d T_robot_camera = Eigen::Isometry3d::Identity();
  T_robot_camera.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  T_robot_camera.translation().z() = kPlanCameraHeight_m;
  VirtualScan scan;
  scan.make(depth, kPlanCamera, plan_table(), plan_floor(), T_robot_camera,
            {0, 0, kPlanWidth_px, kHeight_px}, {});
  return scan;
}

double line_at(double x, double a, double b, double c) {
  const double along_m = c / (a * x + b);
  return along_m > 0.0 ? along_m : kNothing;
}

double circle_at(double x, double left_m, double along_m, double radius_m) {
  // (x r - left)^2 + (r - along)^2 = radius^2
  const double a = x * x + 1.0;
  const double b = x * left_m + along_m;
  const double root = b * b - a * (left_m * left_m + along_m * along_m - radius_m * radius_m);
  return root < 0.0 ? kNothing : (b - std::sqrt(root)) / a;
}

}  // namespace roomwise::landmark
