#include "tests/segment_svc/support/simulated_views.h"

#include <cmath>

#include "services/segment_svc/core/labels.h"
#include "services/simulator/core/kinect/true_labels.h"
#include "tests/support/build_paths.h"

namespace roomwise::segment {
namespace {

constexpr double kMisread_quanta = 4.0;
constexpr double kMisread_ratio = 0.08;

simulator::Scene load(const std::string& scenario, double lamp_level) {
  const auto folder = source_folder() / "services/simulator/scenarios";
  simulator::Scene scene =
      simulator::load_scenario(simulator::find_scenario(scenario, folder)).scene;
  scene.lamp_level *= lamp_level;
  return scene;
}

Eigen::Isometry3d lifted(const Pose2& pose) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(pose.heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T.translation() = Eigen::Vector3d(pose.x_m, pose.y_m, 0.0);
  return T;
}

}  // namespace

SimulatedViews::SimulatedViews(const std::string& scenario, double lamp_level)
    : SimulatedViews(load(scenario, lamp_level)) {}

SimulatedViews::SimulatedViews(const simulator::Scene& scene)
    : scene_(scene), kinect_(scene_, depth_params_, {}, 1) {}

std::vector<Pose2> SimulatedViews::poses(int count) const {
  const simulator::DrivePlan plan(scene_.start, scene_.paths.at(0));
  std::vector<Pose2> poses;
  for (int i = 0; i < count; ++i) {
    poses.push_back(plan.at((i + 0.5) * plan.duration_s() / count).pose);
  }
  return poses;
}

const LabelledFrame& SimulatedViews::look(const Pose2& T_world_robot,
                                          const simulator::CameraMount& mount,
                                          const simulator::CameraMount& claimed) {
  RgbdFrame& frame = seen_.frame;
  kinect_.capture(lifted(T_world_robot) * simulator::T_robot_camera(mount), 0.0, frame_++, mode_,
                  frame);
  frame.T_robot_camera = simulator::T_robot_camera(claimed);
  simulator::true_labels(kinect_.view(), frame.depth.steps, seen_.truth);
  seen_.is_misread.resize(seen_.truth.size());
  for (std::size_t i = 0; i < seen_.truth.size(); ++i) {
    const double read_m = frame.depth.unit_m * frame.depth.steps[i];
    const double true_per_m = static_cast<double>(kinect_.view().inverse_depth_per_m[i]);
    const double off_quanta = std::abs(1.0 / read_m - true_per_m) * depth_params_.quanta_m();
    seen_.is_misread[i] = frame.depth.steps[i] > 0 && off_quanta > kMisread_quanta &&
                          std::abs(read_m * true_per_m - 1.0) > kMisread_ratio;
  }
  return seen_;
}

FloorCounts& FloorCounts::operator+=(const FloorCounts& more) {
  right += more.right;
  missed += more.missed;
  wrong += more.wrong;
  other += more.other;
  return *this;
}

FloorCounts count_floor(const LabelledFrame& seen, const std::vector<std::uint8_t>& labels,
                        Misread misread) {
  FloorCounts counts;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (seen.truth[i] == kUnknown) continue;
    if (misread == Misread::kLeftOut && seen.is_misread[i] != 0) continue;
    const bool is_called = labels[i] == kAccessible;
    if (seen.truth[i] == kAccessible) {
      ++(is_called ? counts.right : counts.missed);
    } else {
      ++(is_called ? counts.wrong : counts.other);
    }
  }
  return counts;
}

}  // namespace roomwise::segment
