#include "services/simulator/render/kinect_renderer.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "tests/simulator/support/plain_scene.h"

namespace roomwise::simulator {
namespace {

constexpr int kWidth_px = 160;
constexpr int kHeight_px = 120;
constexpr double kTolerance_m = 1e-4;

PinholeCamera small_camera() { return kinect_camera(585.0, kWidth_px, kHeight_px); }

KinectView view_of(const Scene& scene, const Eigen::Isometry3d& T_world_camera, double t_s = 0.0) {
  KinectRenderer renderer(scene);
  KinectView view;
  renderer.render(T_world_camera, small_camera(), t_s, kWidth_px, kHeight_px, view);
  return view;
}

std::size_t pixel(int u, int v) { return static_cast<std::size_t>(v * kWidth_px + u); }

/// Ray of a pixel in the world; length 1 along the camera's z.
Eigen::Vector3d ray(const Eigen::Isometry3d& T_world_camera, int u, int v) {
  const PinholeCamera camera = small_camera();
  return T_world_camera.linear() *
         Eigen::Vector3d((u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px, 1.0);
}

/// Checks the depth of every pixel; `depth_of` gives infinity where the thing is missed.
template <class DepthOf>
void expect_depths(const KinectView& view, const Eigen::Isometry3d& T_world_camera,
                   DepthOf&& depth_of) {
  int hits = 0;
  for (int v = 0; v < kHeight_px; ++v) {
    for (int u = 0; u < kWidth_px; ++u) {
      const double expected_m = depth_of(T_world_camera.translation(), ray(T_world_camera, u, v));
      const float inverse = view.inverse_depth_per_m[pixel(u, v)];
      if (inverse == 0.0F || std::isinf(expected_m)) continue;
      ++hits;
      ASSERT_NEAR(1.0 / inverse, expected_m, kTolerance_m) << u << " " << v;
    }
  }
  ASSERT_GT(hits, 500);
}

/// Where a ray enters an axis-aligned box (slabs).
double depth_of_box(const Eigen::Vector3d& low_m, const Eigen::Vector3d& high_m,
                    const Eigen::Vector3d& origin_m, const Eigen::Vector3d& way) {
  const Eigen::Array3d a = (low_m - origin_m).array() / way.array();
  const Eigen::Array3d b = (high_m - origin_m).array() / way.array();
  const double enter = a.min(b).maxCoeff(), leave = a.max(b).minCoeff();
  return enter > 0.0 && enter < leave ? enter : std::numeric_limits<double>::infinity();
}

double depth_of_cylinder(double radius_m, const Eigen::Vector3d& origin_m,
                         const Eigen::Vector3d& way) {
  const Eigen::Vector2d o = origin_m.head<2>(), d = way.head<2>();
  const double b = o.dot(d),
               discriminant = b * b - d.squaredNorm() * (o.squaredNorm() - radius_m * radius_m);
  return discriminant > 0.0 ? (-b - std::sqrt(discriminant)) / d.squaredNorm()
                            : std::numeric_limits<double>::infinity();
}

RC_GTEST_PROP(KinectRenderer, DepthOfAFloorIsExactAtAnyHeightAndTilt, ()) {
  const double height_m = *rc::gen::inRange(20, 200) / 100.0;
  const double pitch_rad = *rc::gen::inRange(0, 120) / 100.0;
  PlainScene plain;
  plain.put_floor();
  const Eigen::Isometry3d camera = camera_pose(height_m, pitch_rad);
  const KinectView view = view_of(plain.scene(), camera);
  for (int v = 0; v < kHeight_px; v += 7) {
    for (int u = 0; u < kWidth_px; u += 7) {
      const double down = -ray(camera, u, v).z();
      const float inverse = view.inverse_depth_per_m[pixel(u, v)];
      if (down < height_m / 25.0) continue;  // near the horizon and above it
      RC_ASSERT(std::abs(inverse - down / height_m) < 1e-5);
      RC_ASSERT(std::abs(1.0 / inverse - height_m / down) <
                kTolerance_m * std::max(1.0, 1.0 / down));
    }
  }
}

RC_GTEST_PROP(KinectRenderer, DisparityOfATurnedWallIsLinearInThePixel, ()) {
  const double heading_rad = *rc::gen::inRange(-60, 60) / 100.0;
  PlainScene plain;
  plain.put_wall(3.0);
  const Eigen::Isometry3d camera =
      Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()) * camera_pose(1.0, 0.1);
  const KinectView view = view_of(plain.scene(), camera);
  for (int v = 0; v < kHeight_px; v += 10) {
    for (int u = 20; u + 20 < kWidth_px; u += 10) {
      const double left = view.inverse_depth_per_m[pixel(u - 20, v)];
      const double right = view.inverse_depth_per_m[pixel(u + 20, v)];
      RC_ASSERT(std::abs(left - 2.0 * view.inverse_depth_per_m[pixel(u, v)] + right) < 1e-6);
    }
  }
}

RC_GTEST_PROP(KinectRenderer, DepthOfABoxIsThatOfTheFirstSlab, ()) {
  const double x_m = *rc::gen::inRange(100, 300) / 100.0;
  const double turn_rad = *rc::gen::inRange(-30, 30) / 100.0;
  const Eigen::Vector3d low_m(x_m, -0.4, 0.2), high_m(x_m + 0.7, 0.3, 1.4);
  PlainScene plain;
  plain.put(box(low_m, high_m));
  const Eigen::Isometry3d camera =
      Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitX()) * camera_pose(1.7, 0.35);
  expect_depths(view_of(plain.scene(), camera), camera,
                [&](const Eigen::Vector3d& origin, const Eigen::Vector3d& way) {
                  return depth_of_box(low_m, high_m, origin, way);
                });
}

TEST(KinectRenderer, DepthOfACylinderIsThatOfTheRoundOne) {
  PlainScene plain;
  plain.put(cylinder(0.4, -3.0, 3.0, 1440));
  Eigen::Isometry3d camera = camera_pose(0.3, 0.05);
  camera.translation().x() = -1.7;
  expect_depths(view_of(plain.scene(), camera), camera,
                [&](const Eigen::Vector3d& origin, const Eigen::Vector3d& way) {
                  const double depth_m = depth_of_cylinder(0.4, origin, way);
                  // A chord's flatness shows up divided by the cosine: leave out the last limb.
                  const Eigen::Vector3d normal = (origin + depth_m * way) / 0.4;
                  const bool is_limb = std::abs(normal.head<2>().dot(way.head<2>())) < 0.1;
                  return is_limb ? std::numeric_limits<double>::infinity() : depth_m;
                });
}

TEST(KinectRenderer, InfraredFallsWithIncidenceAndSquaredRange) {
  PlainScene plain;
  plain.made_of({.name = "paint", .infrared_reflectance = 0.8F}).put_floor();
  const Eigen::Isometry3d camera = camera_pose(0.5, 0.6);
  const KinectView view = view_of(plain.scene(), camera);
  for (int v = 0; v < kHeight_px; v += 17) {
    const Eigen::Vector3d way = ray(camera, 50, v);
    const double range_m = 0.5 / -way.z() * way.norm();
    const double cos_incidence = -way.z() / way.norm();
    EXPECT_NEAR(view.infrared_ratio[pixel(50, v)], 0.8 * cos_incidence / (range_m * range_m), 1e-4);
  }
}

TEST(KinectRenderer, NamesClassAndMaterialAndNothing) {
  PlainScene plain;
  plain.put_floor().made_of({.name = "plaster"});
  plain.put(box({2.0, 0.0, 0.0}, {2.1, 3.0, 1.0}), SurfaceClass::kWall);
  const KinectView view = view_of(plain.scene(), camera_pose(0.5));
  EXPECT_EQ(view.surface_class[pixel(20, 60)], static_cast<std::uint8_t>(SurfaceClass::kWall));
  EXPECT_EQ(view.material[pixel(20, 60)], 1);
  EXPECT_EQ(view.surface_class[pixel(140, 110)], static_cast<std::uint8_t>(SurfaceClass::kFloor));
  EXPECT_EQ(view.material[pixel(140, 110)], 0);
  EXPECT_EQ(view.surface_class[pixel(140, 10)], kNoSurface);
  EXPECT_EQ(view.material[pixel(140, 10)], kNoMaterial);
  EXPECT_EQ(view.inverse_depth_per_m[pixel(140, 10)], 0.0F);
}

TEST(KinectRenderer, NoRaySlipsThroughASurfaceOfManyTriangles) {
  PlainScene plain;
  plain.put(cylinder(5.0, -10.0, 10.0, 997));
  const KinectView view = view_of(plain.scene(), camera_pose(0.0));
  EXPECT_EQ(std::count(view.inverse_depth_per_m.begin(), view.inverse_depth_per_m.end(), 0.0F), 0);
}

TEST(KinectRenderer, WalkersAreWhereTheyWalked) {
  PlainScene plain;
  plain.put_wall(9.0);
  Solid body = box({-0.2, -0.2, 0.0}, {0.2, 0.2, 1.8});
  plain.scene().walkers.push_back(
      {.name = "man", .meshes = {body.mesh}, .way_m = {{2.0, 0.0}, {6.0, 0.0}}, .speed_mps = 1.0});
  KinectRenderer renderer(plain.scene());
  KinectView view;
  for (const double t_s : {0.0, 1.0, 2.5, 0.5}) {
    renderer.render(camera_pose(1.0), small_camera(), t_s, kWidth_px, kHeight_px, view);
    EXPECT_NEAR(1.0 / view.inverse_depth_per_m[pixel(80, 60)], 2.0 + t_s - 0.2, kTolerance_m);
    EXPECT_NEAR(1.0 / view.inverse_depth_per_m[pixel(5, 60)], 9.0, 1e-3);
    EXPECT_EQ(view.surface_class[pixel(80, 60)],
              static_cast<std::uint8_t>(SurfaceClass::kObstacle));
  }
}

/// A mirror 2 m ahead, turned by `turn_rad`, and a wall 1.5 m behind the camera.
PlainScene mirror_scene(double turn_rad) {
  PlainScene plain;
  plain.put(box({-2.5, -30.0, -30.0}, {-1.5, 30.0, 30.0}), SurfaceClass::kWall);
  plain.made_of({.name = "mirror", .mirror = 0.9F});
  plain.put(moved(box({0.0, -0.4, 0.0}, {0.02, 0.4, 2.0}), {2.0, 0.0, turn_rad}));
  return plain;
}

TEST(KinectRenderer, DepthOfAMirrorIsThatOfTheMirrorWorld) {
  PlainScene plain = mirror_scene(0.0);
  const KinectView view = view_of(plain.scene(), camera_pose(1.0));
  EXPECT_NEAR(1.0 / view.inverse_depth_per_m[pixel(80, 60)], 2.0 + 2.0 + 1.5, kTolerance_m);
  EXPECT_NEAR(1.0 / view.inverse_depth_per_m[pixel(90, 40)], 2.0 + 2.0 + 1.5, kTolerance_m);
  EXPECT_EQ(view.surface_class[pixel(80, 60)], static_cast<std::uint8_t>(SurfaceClass::kObstacle));
  EXPECT_EQ(view.material[pixel(80, 60)], 1);
}

RC_GTEST_PROP(KinectRenderer, NothingInAMirrorIsNearerThanTheMirror, ()) {
  const double turn_rad = *rc::gen::inRange(-70, 70) / 100.0;
  PlainScene plain = mirror_scene(turn_rad);
  const KinectView mirrored = view_of(plain.scene(), camera_pose(1.0));
  plain.scene().materials[1].mirror = 0.0F;
  const KinectView plain_view = view_of(plain.scene(), camera_pose(1.0));
  for (std::size_t i = 0; i < mirrored.size(); ++i) {
    RC_ASSERT(mirrored.inverse_depth_per_m[i] <= plain_view.inverse_depth_per_m[i]);
  }
}

TEST(KinectRenderer, WindowGlassHasNoDepthButIsSeenThrough) {
  PlainScene plain;
  plain.put_wall(4.0);
  const KinectView open = view_of(plain.scene(), camera_pose(1.0));
  plain.made_of({.name = "glass", .color = {0.5F, 1.0F, 1.0F}, .see_through = true});
  plain.put(box({2.0, -0.3, 0.7}, {2.01, 0.3, 1.3}), SurfaceClass::kWall);
  const KinectView glazed = view_of(plain.scene(), camera_pose(1.0));
  const std::size_t middle = pixel(80, 60), beside = pixel(5, 60);
  EXPECT_EQ(glazed.inverse_depth_per_m[middle], 0.0F);
  EXPECT_EQ(glazed.infrared_ratio[middle], 0.0F);
  EXPECT_NEAR(glazed.red[middle], 0.25F * open.red[middle], 1e-5);  // two faces of half the red
  EXPECT_NEAR(glazed.green[middle], open.green[middle], 1e-5);
  EXPECT_EQ(glazed.inverse_depth_per_m[beside], open.inverse_depth_per_m[beside]);
}

TEST(KinectRenderer, ALampShinesWithTheCosineAndFallsOffWithDistance) {
  PlainScene plain;
  plain.put_floor();
  plain.scene().ambient = 0.0;
  plain.scene().lamps = {{.position_m = {2.0F, 0.5F, 1.5F}, .power = {2.0F, 1.0F, 0.5F}}};
  const Eigen::Isometry3d camera = camera_pose(0.6, 0.5);
  const KinectView view = view_of(plain.scene(), camera);
  for (int v = 10; v < kHeight_px; v += 25) {
    const Eigen::Vector3d way = ray(camera, 30, v);
    const Eigen::Vector3d p_m = camera.translation() + 0.6 / -way.z() * way;
    const Eigen::Vector3d to_lamp_m = Eigen::Vector3d(2.0, 0.5, 1.5) - p_m;
    const double r_m = to_lamp_m.norm();
    const double light = to_lamp_m.z() / r_m / (1.0 + r_m * r_m);
    EXPECT_NEAR(view.red[pixel(30, v)], 0.6 * 2.0 * light, 1e-4);
    EXPECT_NEAR(view.blue[pixel(30, v)], 0.6 * 0.5 * light, 1e-4);
  }
}

TEST(KinectRenderer, TheSecondCameraSeesColorFromItsOwnPlace) {
  PlainScene plain;
  plain.put_wall(4.0).made_of({.name = "white", .color = {1.0F, 1.0F, 1.0F}});
  plain.put(box({1.0, 0.0, -5.0}, {1.1, 3.0, 5.0}));  // its edge is straight ahead
  KinectRenderer renderer(plain.scene());
  KinectView view;
  const Eigen::Isometry3d camera = camera_pose(1.0);
  renderer.render(camera, small_camera(), camera * Eigen::Translation3d(0.1, 0.0, 0.0),
                  kinect_camera(500.0, kWidth_px, kHeight_px), 0.0, kWidth_px, kHeight_px, view);
  const double edge_px = 80.0 - 500.0 / 4.0 * 0.1 / 1.0;
  for (int u = 0; u < kWidth_px; ++u) {
    EXPECT_EQ(view.inverse_depth_per_m[pixel(u, 60)] > 0.5F, u <= 80) << u;
    if (std::abs(u - edge_px) > 0.6) {
      EXPECT_EQ(view.red[pixel(u, 60)] > 0.8F, u < edge_px) << u;
    }
  }
}

TEST(KinectRenderer, AnyImageSizeIsFilled) {
  PlainScene plain;
  plain.put_wall(2.0);
  KinectRenderer renderer(plain.scene());
  KinectView view;
  for (const auto& [width_px, height_px] : {std::pair{640, 480}, {33, 17}, {1, 1}, {320, 240}}) {
    renderer.render(camera_pose(1.0), kinect_camera(585.0, width_px, height_px), 0.0, width_px,
                    height_px, view);
    ASSERT_EQ(view.size(), static_cast<std::size_t>(width_px * height_px));
    for (const float inverse : view.inverse_depth_per_m) ASSERT_NEAR(inverse, 0.5F, 1e-5F);
  }
}

TEST(KinectRenderer, RefusesBrokenMeshesByName) {
  Scene scene;
  scene.name = "broken";
  scene.materials.push_back({.name = "grey"});
  Mesh mesh{.corners_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
            .texture_m = {{0, 0}, {1, 0}, {0, 1}},
            .triangles = {{0, 1, 3}}};
  scene.meshes = {mesh};
  EXPECT_THROW(KinectRenderer{scene}, std::runtime_error);
  scene.meshes[0].triangles = {{0, 1, 2}};
  EXPECT_NO_THROW(KinectRenderer{scene});
  scene.meshes[0].material = 1;
  EXPECT_THROW(KinectRenderer{scene}, std::runtime_error);
  scene.meshes[0].material = 0;
  scene.meshes[0].corners_m[1].x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(KinectRenderer{scene}, std::runtime_error);
}

TEST(KinectRenderer, AnEmptyWorldIsSky) {
  Scene scene;
  const KinectView view = view_of(scene, camera_pose(1.0));
  EXPECT_EQ(view.inverse_depth_per_m[0], 0.0F);
  EXPECT_GT(view.blue[0], view.red[0]);
}

}  // namespace
}  // namespace roomwise::simulator
