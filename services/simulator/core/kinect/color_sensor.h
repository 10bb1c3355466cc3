#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "common/image/rgbd_frame.h"
#include "services/simulator/core/kinect/kinect_params.h"
#include "services/simulator/core/kinect/kinect_view.h"

namespace roomwise::simulator {

/// How bright the lamps are at `t_s`, around 1: a slow swing, and bars of mains light rolling over
/// the rows of a sensor that reads them one after the other. `row_ratio` is the row, 0..1.
double lamp_factor(const ColorSensorParams& params, double t_s, double row_ratio);

/// A colour camera with automatic exposure: soft lens, gain, noise, 8 bits. Levels go with the root
/// of the light, which makes photon noise, whose variance goes with the light, the same at all
/// levels; it grows with the root of the gain, so pictures of dark places are noisy. The same seed,
/// frame numbers, times and views give the same bytes.
class ColorSensor {
 public:
  ColorSensor(const ColorSensorParams& params, std::uint32_t seed);

  /// Takes the picture, then steers the gain by a small step towards what it should have been; the
  /// first picture has the gain it should. Allocates nothing after the first image of a size.
  void expose(const KinectView& view, std::int64_t frame, double t_s, ColorImage& out);

  double gain() const { return gain_; }

 private:
  double wanted_gain(const KinectView& view) const;
  void steer(double wanted_gain);
  void gather_light(const KinectView& view, int v);

  ColorSensorParams params_;
  std::uint32_t seed_ = 0;
  double gain_ = 0.0;          ///< 0: no picture taken yet
  std::vector<float> levels_;  ///< of one row: red, green, blue
};

}  // namespace roomwise::simulator
