#include "services/simulator/core/kinect/true_labels.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "services/simulator/core/scene.h"
#include "tests/simulator/support/ideal_views.h"

namespace roomwise::simulator {
namespace {

TEST(TrueLabels, AreThoseOfSegmentationAndUnknownWithoutReading) {
  KinectView view = even_view(2.0, 6, 1);
  view.surface_class = {static_cast<std::uint8_t>(SurfaceClass::kObstacle),
                        static_cast<std::uint8_t>(SurfaceClass::kWall),
                        static_cast<std::uint8_t>(SurfaceClass::kFloor),
                        static_cast<std::uint8_t>(SurfaceClass::kDropOff),
                        kNoSurface,
                        static_cast<std::uint8_t>(SurfaceClass::kFloor)};
  const std::vector<std::uint16_t> depth_steps = {900, 900, 900, 900, 900, 0};
  std::vector<std::uint8_t> labels;
  true_labels(view, depth_steps, labels);
  EXPECT_EQ(labels, (std::vector<std::uint8_t>{0, 100, 200, 50, 255, 255}));
}

TEST(TrueLabels, RefuseImagesOfDifferentSizes) {
  std::vector<std::uint8_t> labels;
  EXPECT_THROW(true_labels(even_view(2.0, 6, 1), std::vector<std::uint16_t>(5), labels),
               std::invalid_argument);
}

}  // namespace
}  // namespace roomwise::simulator
