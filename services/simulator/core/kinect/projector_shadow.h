#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace roomwise::simulator {

/// What the projector, to the right of the camera, cannot light because something nearer stands in
/// its way: a strip beside the left edge of near things, (d_near - d_far) wide, d being the
/// disparity between projector and camera in pixels of the image.
///
/// A ray of the projector lies in one row and hits column u of the image at u = p + d, where p is
/// the column it leaves by. The surface of the largest disparity along p takes the light. Only what
/// the camera sees is known to cast shadow, and steps of less than a pixel of disparity cast none.
class ProjectorShadow {
 public:
  /// Makes room for rows of that many pixels, at least one.
  void resize(int width_px);

  /// Sets to 0 every element of `row` in shadow. Elements are in units of which `px_per_unit` make
  /// a pixel of disparity; those that are 0 (nothing seen) neither cast nor take shadow.
  void apply(std::span<float> row, float px_per_unit);

 private:
  std::vector<float> nearest_;  ///< by column of the projector: what it lights there
  std::vector<std::int32_t> column_;
};

}  // namespace roomwise::simulator
