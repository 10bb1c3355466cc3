#pragma once
#include "common/image/rgbd_frame.h"
#include "services/kinect_pub/core/kinect_params.h"

namespace roomwise::kinect {

/// Camera of a width_px x height_px image with these fields of view, principal point in the middle
/// of the image as OpenNI2 has it (X = (u / W - 1/2) Z 2 tan(hfov / 2)):
/// fx = W / (2 tan(hfov / 2)), cx = W / 2. Fields of view in (0, pi).
PinholeCamera camera_from_fields_of_view(int width_px, int height_px, double horizontal_rad,
                                         double vertical_rad);

/// Camera of an OpenNI2 video stream, by the mode and the fields of view it states.
template <class Stream>
PinholeCamera camera_of(const Stream& stream) {
  const auto mode = stream.getVideoMode();
  return camera_from_fields_of_view(mode.getResolutionX(), mode.getResolutionY(),
                                    stream.getHorizontalFieldOfView(),
                                    stream.getVerticalFieldOfView());
}

/// Whether its focal lengths are those of a camera: a stream may state no field of view.
bool is_usable(const PinholeCamera& camera);

/// Pose of the camera (z forward, x right, y down) on the robot (x forward, y left, z up), mounted
/// as `params` says: p_robot = T p_camera. Yaw turns first, then pitch, then roll, each about the
/// camera's own axes.
Eigen::Isometry3d camera_on_robot(const KinectParams& params);

}  // namespace roomwise::kinect
