#pragma once
#include <cstdint>

#include "common/image/rgbd_frame.h"

namespace roomwise {

/// A depth image and the colour image of the same instant, as a device gave them.
struct CapturedFrame {
  std::int64_t utime = 0;           ///< middle of the exposure, host clock
  std::int64_t device_time_us = 0;  ///< depth image's, device clock
  DepthImage depth;
  ColorImage color;  ///< empty if there is none
  bool depth_registered = false;
  PinholeCamera depth_camera;
  PinholeCamera color_camera;
};

}  // namespace roomwise
