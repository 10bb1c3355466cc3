#pragma once
#include <functional>

#include "services/landmark_svc/core/virtual_scan.h"

namespace roomwise::landmark {

/// 8 f b of the made sensor.
inline constexpr double kPlanQuanta_m = 351.0;
inline constexpr int kPlanWidth_px = 320;
inline constexpr PinholeCamera kPlanCamera{292.5, 292.5, 159.5, 119.5};
inline constexpr double kPlanCameraHeight_m = 0.4;

/// What a level camera at the robot's origin sees of upright things. `along_m(x)` tells how far
/// along the viewing direction the nearest lies at x = left / along; infinity: nothing. Every
/// pixel's disparity gets an error of sigma `noise_quanta` and is rounded.
VirtualScan scan_of_plan(const std::function<double(double)>& along_m, double noise_quanta,
                         std::uint32_t seed);

DisparityTable plan_table();
FloorView plan_floor();

/// Distance along at x of the line a l + b r = c, l to the left and r along; infinity behind.
double line_at(double x, double a, double b, double c);
/// Likewise of a circle's near side.
double circle_at(double x, double left_m, double along_m, double radius_m);

}  // namespace roomwise::landmark
