#pragma once
#include <array>
#include <vector>

namespace roomwise::simulator {

/// Disparity in quanta of 1/8 px, row by row; 0 or less is a hole.
struct DisparityImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> quanta;

  float at(int u_px, int v_px) const {
    return quanta[static_cast<std::size_t>(v_px) * static_cast<std::size_t>(width_px) +
                  static_cast<std::size_t>(u_px)];
  }
};

/// How disparity scatters about planes.
struct PlaneScatter {
  static constexpr int kLags = 10;
  int windows = 0;
  double sigma_quanta = 0.0;              ///< of the residual, mean over the windows
  double second_difference_quanta = 0.0;  ///< root mean square of x(u-8) - 2 x(u) + x(u+8)
  std::array<double, kLags> across{};     ///< autocorrelation along rows, by shift in px
  std::array<double, kLags> down{};       ///< along columns
};

/// Fits a plane to every window of 24 x 24 px, half overlapping, that has at most 2 % holes, and
/// tells how disparity scatters about it in those that are flat: no residual of 4 quanta or more.
PlaneScatter plane_scatter(const std::vector<DisparityImage>& images);

/// Root mean square difference of the same pixel in successive images, of those that differ by less
/// than 6 quanta.
double frame_difference_quanta(const std::vector<DisparityImage>& images);

}  // namespace roomwise::simulator
