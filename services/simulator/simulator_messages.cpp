#include "services/simulator/simulator_messages.h"

namespace roomwise::simulator {
namespace {

true_landmark_t true_landmark(const SceneLandmark& landmark) {
  true_landmark_t message{};
  message.identity = landmark.identity;
  message.kind = static_cast<std::int8_t>(landmark.kind);
  message.true_x_m = landmark.position_m.x();
  message.true_y_m = landmark.position_m.y();
  return message;
}

void write_camera(const Eigen::Isometry3d& T_world_camera, truth_t& truth) {
  const Eigen::Quaterniond q(T_world_camera.rotation());
  truth.has_camera_pose = 1;
  for (int i = 0; i < 3; ++i) {
    truth.T_world_camera_translation_m[i] = T_world_camera.translation()[i];
  }
  truth.T_world_camera_quat[0] = q.w();
  truth.T_world_camera_quat[1] = q.x();
  truth.T_world_camera_quat[2] = q.y();
  truth.T_world_camera_quat[3] = q.z();
}

}  // namespace

truth_t truth_message(const SimulatedWorld& world, Time stamp, bool with_landmarks) {
  const RobotMotion& motion = world.create().motion();
  truth_t truth{};
  truth.utime = utime_of(stamp);
  truth.true_x_m = motion.pose().x_m;
  truth.true_y_m = motion.pose().y_m;
  truth.true_heading_rad = motion.pose().heading_rad;
  write_camera(world.T_world_camera(), truth);
  truth.contacts = static_cast<std::int32_t>(motion.touches().size());
  if (with_landmarks) {
    for (const SceneLandmark& landmark : world.scene().landmarks) {
      truth.true_landmarks.push_back(true_landmark(landmark));
    }
  }
  truth.landmark_count = static_cast<std::int32_t>(truth.true_landmarks.size());
  return truth;
}

}  // namespace roomwise::simulator
