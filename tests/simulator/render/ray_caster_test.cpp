#include "services/simulator/render/ray_caster.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "services/simulator/render/kinect_renderer.h"
#include "tests/simulator/support/plain_scene.h"

namespace roomwise::simulator {
namespace {

constexpr int kImageWidth_px = 320;
constexpr int kImageHeight_px = 240;

/// Things through one another, thin ones, round ones, and one that walks. No two faces lie in one
/// plane: from inside the walker none could say which of floor and sole is in front.
PlainScene cluttered() {
  PlainScene plain;
  plain.put_floor().put_wall(5.0);
  plain.put(moved(box({-0.4, -0.5, -0.2}, {0.4, 0.5, 0.7}), {2.0, 0.3, 0.4}));
  plain.put(moved(box({-0.4, -0.5, -0.2}, {0.4, 0.5, 0.7}), {2.3, 0.5, 1.1}, 0.1));
  plain.put(moved(cylinder(0.3, -1.0, 1.5), {3.0, -0.8, 0.0}));
  plain.put(moved(cylinder(0.01, 0.0, 1.5, 5), {1.2, -0.3, 0.0}));
  plain.put(moved(box({-1.0, -1.0, 0.0}, {1.0, 1.0, 0.01}), {3.0, 0.5, 0.7}, 0.35));
  plain.scene().walkers.push_back({.name = "man",
                                   .meshes = {cylinder(0.25, -0.1, 1.8).mesh},
                                   .way_m = {{1.0, 0.5}, {4.0, -0.5}},
                                   .speed_mps = 1.0});
  return plain;
}

/// What a pixel shows, and SurfaceTable's number of it.
class Casts {
 public:
  Casts() : table_(plain_.scene()), caster_(plain_.scene(), table_) {}

  void walk(double t_s) {
    const Pose2 pose = walker_pose(plain_.scene().walkers[0], t_s);
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation() << pose.x_m, pose.y_m, 0.0;
    caster_.move(1, T);
    caster_.commit();
  }

  /// Pixels at which the picture cast by blocks shows another piece than one cast ray by ray.
  int differences(const RayFrame& rays) {
    constexpr auto kPixels = static_cast<std::size_t>(kImageWidth_px * kImageHeight_px);
    std::vector<std::uint32_t> by_blocks(kPixels), by_rays(kPixels);
    caster_.cast(rays, kImageWidth_px, kImageHeight_px, by_blocks.data());
    const std::vector<float> from_m(kImageWidth_px, 0.0F);
    for (int v = 0; v < kImageHeight_px; ++v) {
      caster_.cast_row(rays, v, 0, kImageWidth_px, from_m.data(),
                       by_rays.data() + v * kImageWidth_px);
    }
    int count = 0;
    for (std::size_t i = 0; i < kPixels; ++i) count += piece(by_blocks[i]) != piece(by_rays[i]);
    return count;
  }

 private:
  std::uint32_t piece(std::uint32_t triangle) const {
    return triangle == kNoTriangle ? kNoTriangle : table_.flat_piece(triangle);
  }

  PlainScene plain_ = cluttered();
  SurfaceTable table_;
  RayCaster caster_;
};

RC_GTEST_PROP(RayCaster, BlocksShowWhatSingleRaysShowButForRoundingAtEdges, ()) {
  Casts casts;
  casts.walk(*rc::gen::inRange(0, 60) / 10.0);
  Eigen::Isometry3d camera =
      camera_pose(*rc::gen::inRange(5, 180) / 100.0, *rc::gen::inRange(-50, 120) / 100.0);
  camera = Eigen::AngleAxisd(*rc::gen::inRange(-300, 300) / 100.0, Eigen::Vector3d::UnitZ()) *
           Eigen::AngleAxisd(*rc::gen::inRange(-30, 30) / 100.0, Eigen::Vector3d::UnitX()) * camera;
  camera.translation().x() = *rc::gen::inRange(-100, 450) / 100.0;
  const RayFrame rays = ray_frame(kinect_camera(525.0, kImageWidth_px, kImageHeight_px), camera);
  RC_ASSERT(casts.differences(rays) <= 4);
}

TEST(EdgeBlocks, AreFewerThanAllWhereThereIsLittleToSee) {
  PlainScene plain;
  plain.put_wall(3.0).put(box({1.0, -0.1, 0.5}, {1.1, 0.1, 1.5}));
  const SurfaceTable table(plain.scene());
  EdgeBlocks blocks(plain.scene(), table);
  blocks.mark(ray_frame(kinect_camera(525.0, 640, 480), camera_pose(1.0)), 640, 480);
  constexpr int kOf8_px = 2;
  int marked = 0;
  for (int row = 0; row < blocks.rows(kOf8_px); ++row) {
    for (int column = 0; column < blocks.columns(kOf8_px); ++column)
      marked += blocks.has_edge(kOf8_px, column, row);
  }
  EXPECT_GT(marked, 200);
  EXPECT_LT(marked, 600);  // of 4800
  EXPECT_TRUE(blocks.has_edge(kOf8_px, 40 - 7, 30));
  EXPECT_FALSE(blocks.has_edge(kOf8_px, 40, 30));
}

TEST(EdgeBlocks, HaveTheEdgesOfTheirParts) {
  PlainScene plain;
  plain.put_wall(3.0).put(box({1.0, -0.1, 0.5}, {1.1, 0.1, 1.5}));
  const SurfaceTable table(plain.scene());
  EdgeBlocks blocks(plain.scene(), table);
  blocks.mark(ray_frame(kinect_camera(525.0, 640, 480), camera_pose(1.0)), 640, 480);
  for (int level = 1; level < EdgeBlocks::kLevels; ++level) {
    for (int row = 0; row < blocks.rows(level); ++row) {
      for (int column = 0; column < blocks.columns(level); ++column) {
        if (!blocks.has_edge(level, column, row)) continue;
        EXPECT_TRUE(blocks.has_edge(level - 1, column / 2, row / 2));
      }
    }
  }
}

TEST(EdgeBlocks, ABlockThatReachesBeyondTheImageIsNeverTakenAsAWhole) {
  PlainScene plain;
  plain.put_wall(3.0);
  const SurfaceTable table(plain.scene());
  EdgeBlocks blocks(plain.scene(), table);
  blocks.mark(ray_frame(kinect_camera(525.0, 20, 12), camera_pose(1.0)), 20, 12);
  EXPECT_TRUE(blocks.has_edge(0, 0, 0));  // 32 px
  EXPECT_FALSE(blocks.has_edge(2, 0, 0));
  EXPECT_TRUE(blocks.has_edge(2, 2, 0));
  EXPECT_TRUE(blocks.has_edge(2, 0, 1));
  EXPECT_FALSE(blocks.has_edge(EdgeBlocks::kFinest, 4, 2));  // 20 and 12 are whole tiles
}

}  // namespace
}  // namespace roomwise::simulator
