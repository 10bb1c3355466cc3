#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/simulator/core/kinect/correlated_noise.h"
#include "services/simulator/core/kinect/kinect_params.h"
#include "services/simulator/core/kinect/kinect_view.h"
#include "services/simulator/core/kinect/projector_shadow.h"
#include "services/simulator/core/kinect/ragged_edges.h"

namespace roomwise::simulator {

/// Largest disparity a depth image can hold, in quanta; 0 is a hole.
inline constexpr int kQuantaMax = 1089;

/// Disparity as the Kinect's 11 bits have it: 1090 - quanta, or 2047 where there is no reading.
/// Source: K. Konolige, P. Mihelich, "Technical description of Kinect calibration", 2011, with
/// disparity offset 1090.
constexpr std::uint16_t raw_shift(std::uint16_t quanta) {
  return quanta == 0 ? std::uint16_t{2047} : static_cast<std::uint16_t>(kQuantaMax + 1 - quanta);
}

/// The failings of a structured-light depth camera, put on an ideal view one after the other:
/// projector shadow, ragged edges, disparity noise, too little light, blind zone and range limit,
/// dropouts, disparity rounded to 1/8 px, a blind strip at the right border, depth in whole mm.
/// The same seed, frame numbers and views give the same bytes.
class DepthSensor {
 public:
  DepthSensor(const DepthSensorParams& params, std::uint32_t seed);

  /// `projector_px_m`: disparity between the view and the projector times depth, that is the view's
  /// focal length (px) times how far the projector is to its right (m).
  /// Allocates nothing after the first image of a size.
  void expose(const KinectView& view, double projector_px_m, std::int64_t frame, DepthImage& out);

  /// Disparities of the last image, 1/8 px each; 0 is a hole. Shape: height x width.
  std::span<const std::uint16_t> quanta() const { return quanta_; }

 private:
  void resize(const KinectView& view);
  void fill_pattern();
  void cast_shadow(const KinectView& view, double projector_px_m);
  void expose_row(const KinectView& view, int v, std::uint32_t key, DepthImage& out);
  void drop_patches(std::uint32_t key, DepthImage& out);

  DepthSensorParams params_;
  std::uint32_t seed_ = 0;
  int width_px_ = 0;
  int height_px_ = 0;
  ProjectorShadow shadow_;
  RaggedEdges ragged_;
  std::optional<CorrelatedNoise> noise_;
  std::vector<float> pattern_;           ///< error that stays, quanta, height x width
  std::vector<float> disparity_;         ///< quanta, of the view, then lit parts only
  std::vector<float> row_;               ///< of disparity_, with ragged edges
  std::vector<std::uint16_t> quanta_;    ///< as measured
  std::vector<std::uint16_t> depth_mm_;  ///< by quanta
};

}  // namespace roomwise::simulator
