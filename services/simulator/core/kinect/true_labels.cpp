#include "services/simulator/core/kinect/true_labels.h"

#include <array>
#include <stdexcept>

#include "services/simulator/core/scene.h"

namespace roomwise::simulator {
namespace {

constexpr std::uint8_t kUnknown = 255;

constexpr std::uint8_t label_of(std::uint8_t surface_class) {
  switch (surface_class) {
    case static_cast<std::uint8_t>(SurfaceClass::kObstacle):
      return 0;
    case static_cast<std::uint8_t>(SurfaceClass::kWall):
      return 100;
    case static_cast<std::uint8_t>(SurfaceClass::kFloor):
      return 200;
    case static_cast<std::uint8_t>(SurfaceClass::kDropOff):
      return 50;
    default:
      return kUnknown;
  }
}

}  // namespace

void true_labels(const KinectView& view, std::span<const std::uint16_t> depth_steps,
                 std::vector<std::uint8_t>& labels) {
  if (depth_steps.size() != view.size()) throw std::invalid_argument("true labels: sizes differ");
  labels.resize(view.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    labels[i] = depth_steps[i] == 0 ? kUnknown : label_of(view.surface_class[i]);
  }
}

}  // namespace roomwise::simulator
