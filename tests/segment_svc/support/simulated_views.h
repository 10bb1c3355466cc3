#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/simulator/core/path_plan.h"
#include "services/simulator/render/simulated_kinect.h"
#include "services/simulator/scenario/scenario.h"

namespace roomwise::segment {

/// A frame together with what a perfect segmentation of it would be.
struct LabelledFrame {
  RgbdFrame frame;
  std::vector<std::uint8_t> truth;  ///< values of Label; unknown where there is no reading
  /// 1 where the reading is not of the surface the pixel's ray meets: more than 4 quanta off, as
  /// beside the edge of something near. Depth cannot tell there. height x width.
  std::vector<std::uint8_t> is_misread;
};

/// A simulated Kinect in a room of services/simulator/scenarios, 320 x 240 unless told otherwise.
class SimulatedViews {
 public:
  explicit SimulatedViews(const std::string& scenario, double lamp_level = 1.0);
  explicit SimulatedViews(const simulator::Scene& scene);

  const LabelledFrame& last() const { return seen_; }
  /// Of the last look: what an ideal sensor would see.
  const simulator::KinectView& ideal() const { return kinect_.view(); }
  const simulator::Scene& scene() const { return scene_; }
  void set_width(int width_px) { mode_ = {.width_px = width_px, .height_px = width_px * 3 / 4}; }

  /// Robot poses along the first path, `count` of them equally far apart in time.
  std::vector<Pose2> poses(int count) const;

  /// What a camera mounted like `mount` sees; its mounting is claimed to be `claimed`.
  const LabelledFrame& look(const Pose2& T_world_robot, const simulator::CameraMount& mount,
                            const simulator::CameraMount& claimed);
  const LabelledFrame& look(const Pose2& T_world_robot, const simulator::CameraMount& mount) {
    return look(T_world_robot, mount, mount);
  }

 private:
  simulator::Scene scene_;
  simulator::DepthSensorParams depth_params_;
  simulator::SimulatedKinect kinect_;
  simulator::KinectMode mode_{.width_px = 320, .height_px = 240};
  std::int64_t frame_ = 0;
  LabelledFrame seen_;
};

/// Pixels of label images against the truth, by what is true and what was said.
struct FloorCounts {
  double right = 0.0;
  double missed = 0.0;
  double wrong = 0.0;  ///< something else, called floor
  double other = 0.0;  ///< something else, not called floor

  double iou_ratio() const { return right / (right + missed + wrong); }
  double wrong_ratio() const { return wrong / (wrong + other); }
  FloorCounts& operator+=(const FloorCounts& more);
};

enum class Misread { kCounted, kLeftOut };

/// Counts the pixels whose truth is known.
FloorCounts count_floor(const LabelledFrame& seen, const std::vector<std::uint8_t>& labels,
                        Misread misread = Misread::kCounted);

}  // namespace roomwise::segment
