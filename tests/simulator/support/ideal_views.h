#pragma once
#include "services/simulator/core/kinect/kinect_view.h"

namespace roomwise::simulator {

/// An evenly lit white surface facing the camera at `depth_m`.
inline KinectView even_view(double depth_m, int width_px = 640, int height_px = 480) {
  KinectView view;
  view.resize(width_px, height_px);
  view.inverse_depth_per_m.assign(view.size(), static_cast<float>(1.0 / depth_m));
  view.infrared_ratio.assign(view.size(), static_cast<float>(1.0 / (depth_m * depth_m)));
  view.surface_class.assign(view.size(), 0);
  view.material.assign(view.size(), 0);
  for (auto* light : {&view.red, &view.green, &view.blue}) light->assign(view.size(), 0.25F);
  return view;
}

}  // namespace roomwise::simulator
