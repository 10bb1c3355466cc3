#include "services/kinect_pub/core/camera_geometry.h"

#include <cmath>

namespace roomwise::kinect {

PinholeCamera camera_from_fields_of_view(int width_px, int height_px, double horizontal_rad,
                                         double vertical_rad) {
  return {.fx_px = width_px / (2.0 * std::tan(horizontal_rad / 2.0)),
          .fy_px = height_px / (2.0 * std::tan(vertical_rad / 2.0)),
          .cx_px = width_px / 2.0,
          .cy_px = height_px / 2.0};
}

bool is_usable(const PinholeCamera& camera) {
  return std::isfinite(camera.fx_px) && std::isfinite(camera.fy_px) && camera.fx_px > 0.0 &&
         camera.fy_px > 0.0;
}

Eigen::Isometry3d camera_on_robot(const KinectParams& params) {
  Eigen::Matrix3d R_level_camera;  // camera axes on a robot's when it looks straight ahead
  R_level_camera << 0, 0, 1,       //
      -1, 0, 0,                    //
      0, -1, 0;
  Eigen::Isometry3d T_robot_camera = Eigen::Isometry3d::Identity();
  T_robot_camera.translation() << params.camera_x_m, params.camera_y_m, params.camera_height_m;
  T_robot_camera.linear() =
      Eigen::AngleAxisd(params.camera_yaw_rad, Eigen::Vector3d::UnitZ()) *
      Eigen::AngleAxisd(params.camera_pitch_rad, Eigen::Vector3d::UnitY()) *
      Eigen::AngleAxisd(params.camera_roll_rad, Eigen::Vector3d::UnitX()).toRotationMatrix() *
      R_level_camera;
  return T_robot_camera;
}

}  // namespace roomwise::kinect
