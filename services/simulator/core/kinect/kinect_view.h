#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace roomwise::simulator {

/// `KinectView::surface_class` where no ray met anything.
inline constexpr std::uint8_t kNoSurface = 255;
/// `KinectView::material` there.
inline constexpr std::uint16_t kNoMaterial = 65535;

/// What reaches the cameras of an ideal Kinect, row by row: no noise, no rounding, no shadow.
struct KinectView {
  int width_px = 0;
  int height_px = 0;
  /// 1 / depth along the camera's z, which is linear over a plane; 0 where there is no reading to
  /// be had (nothing there, window glass).
  std::vector<float> inverse_depth_per_m;
  /// Infrared light coming back, as a share of what a white face-on surface 1 m away returns.
  std::vector<float> infrared_ratio;
  std::vector<std::uint8_t> surface_class;  ///< SurfaceClass of what stands there, or kNoSurface
  std::vector<std::uint16_t> material;      ///< index into Scene::materials, or kNoMaterial
  std::vector<float> red, green, blue;      ///< light, linear; 1 is white in full ambient light

  /// Makes room for images of that size; what was there is lost.
  void resize(int new_width_px, int new_height_px) {
    width_px = new_width_px;
    height_px = new_height_px;
    const auto pixels = static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px);
    for (auto* plane : {&inverse_depth_per_m, &infrared_ratio, &red, &green, &blue})
      plane->resize(pixels);
    surface_class.resize(pixels);
    material.resize(pixels);
  }
  std::size_t size() const { return inverse_depth_per_m.size(); }
};

}  // namespace roomwise::simulator
