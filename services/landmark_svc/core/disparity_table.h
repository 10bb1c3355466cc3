#pragma once
#include <cstdint>
#include <vector>

namespace roomwise::landmark {

/// From a depth step to the disparity a Kinect-class camera measured.
///
/// Such a camera measures the shift of a projected pattern in eighths of a pixel, so its noise is
/// uniform in disparity, not in depth:
///
///   D = 8 f b / z  [quanta],   one quantum of depth is z^2 / (8 f b)
///
/// with f the focal length of the grid the sensor matches on and b the projector's baseline. On a
/// plane D is exactly linear in pixel coordinates. Kept in eighths of a quantum, so that the
/// table's own rounding is small beside the sensor's.
///
/// Source: Khoshelham and Elberink, "Accuracy and Resolution of Kinect Depth Data for Indoor
/// Mapping Applications", Sensors 12 (2012).
class DisparityTable {
 public:
  static constexpr int kPartsPerQuantum = 8;
  static constexpr double kDepthMax_m = 4.095;  ///< 12 bits of millimetres; farther is bad data
  static constexpr double kBeyondMax_m = 10.0;  ///< nor does any tell what is farther
  static constexpr double kDepthMin_m = 0.06;   ///< no such camera measures nearer

  /// Makes the table for images of `unit_m` metres a step and a sensor of `quanta_m` = 8 f b.
  /// Both must be positive and finite. Does nothing if both are as before; allocates once.
  void prepare(double unit_m, double quanta_m);

  /// True for a reading: false for 0, 0xFFFF (-1 in the Kinect SDK) and beyond 4095 mm. A bad
  /// reading means unknown, never free.
  bool is_good(std::uint16_t step) const { return parts_[step] != 0; }

  /// True for a reading that is bad only because it is too far, up to 10 m: it has no place worth
  /// having, but what it belongs to is farther than anything good.
  bool is_beyond(std::uint16_t step) const {
    return step > largest_good_step_ && step <= largest_beyond_step_;
  }
  /// Disparity of such a reading, as parts().
  int parts_beyond(std::uint16_t step) const {
    return static_cast<int>(kPartsPerQuantum * quanta_m_ / depth_m(step));
  }

  /// Disparity in eighths of a quantum; 0 for a bad reading.
  std::uint16_t parts(std::uint16_t step) const { return parts_[step]; }

  /// Smallest and largest good step; no step is good if largest < smallest.
  int smallest_good_step() const { return smallest_good_step_; }
  int largest_good_step() const { return largest_good_step_; }
  int largest_beyond_step() const { return largest_beyond_step_; }

  double depth_m(std::uint16_t step) const { return step * unit_m_; }
  double depth_from_quanta_m(double quanta) const { return quanta_m_ / quanta; }

  /// 8 f b: disparity in quanta times depth.
  double quanta_m() const { return quanta_m_; }
  /// Disparity in quanta times step, likewise the same for all.
  double quanta_steps() const { return quanta_m_ / unit_m_; }

  /// Depth of one quantum at depth `z_m`.
  double quantum_m(double z_m) const { return z_m * z_m / quanta_m_; }

  /// `length_m` in whole steps, rounded up, in [1, 65535].
  std::uint16_t steps_from_m(double length_m) const;

 private:
  double unit_m_ = 0.0;
  double quanta_m_ = 0.0;
  int smallest_good_step_ = 1;
  int largest_good_step_ = 0;
  int largest_beyond_step_ = 0;
  std::vector<std::uint16_t> parts_;
};

}  // namespace roomwise::landmark
