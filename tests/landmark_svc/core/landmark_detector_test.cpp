#include "services/landmark_svc/core/landmark_detector.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "common/geometry/angle.h"
#include "tests/landmark_svc/support/kinect_effects.h"
#include "tests/support/synthetic_room.h"

namespace roomwise::landmark {
namespace {

constexpr double kQuanta_m = 351.0;

/// What a Kinect at this pose sees of the furnished room, shadow, raggedness and dropouts included.
RgbdFrame kinect_view(const SyntheticRoom& room, const SyntheticCamera& camera, const Pose2& pose,
                      std::uint32_t seed) {
  RgbdFrame frame = render(room, camera, pose, seed);
  add_projector_shadow(frame.depth, kQuanta_m);
  add_ragged_edges(frame.depth, seed);
  add_dropouts(frame.depth, 0.01, seed);
  return frame;
}

std::vector<Landmark> detect(const RgbdFrame& frame, const LandmarkParams& params = {}) {
  LandmarkDetector detector(params);
  EXPECT_EQ(detector.detect(frame), DetectResult::kOk);
  return detector.landmarks();
}

bool is_edge(const Landmark& landmark) {
  return landmark.kind == LandmarkKind::kEdgeLeft || landmark.kind == LandmarkKind::kEdgeRight;
}

bool is_crease(const Landmark& landmark) {
  return landmark.kind == LandmarkKind::kCreaseConvex ||
         landmark.kind == LandmarkKind::kCreaseConcave;
}

/// The scan is taken at heights above the floor: creases change as the camera is lifted.
std::vector<Landmark> without_creases(std::vector<Landmark> landmarks) {
  std::erase_if(landmarks, is_crease);
  return landmarks;
}

Eigen::Vector2d position_m(const Landmark& landmark) {
  return landmark.range_m *
         Eigen::Vector2d(std::cos(landmark.bearing_rad), std::sin(landmark.bearing_rad));
}

/// Every vertical edge of every box, in the robot frame.
std::vector<Eigen::Vector2d> true_edges_m(const SyntheticRoom& room, const Pose2& pose) {
  std::vector<Eigen::Vector2d> edges;
  for (const SyntheticBox& box : room.boxes) {
    for (const double x : {box.low_m.x(), box.high_m.x()}) {
      for (const double y : {box.low_m.y(), box.high_m.y()}) {
        edges.push_back(transform(inverse(pose), {x, y}));
      }
    }
  }
  return edges;
}

Eigen::Vector2d nearest_m(const std::vector<Eigen::Vector2d>& edges, const Landmark& landmark) {
  const Eigen::Vector2d p = position_m(landmark);
  return *std::min_element(edges.begin(), edges.end(), [&](const auto& a, const auto& b) {
    return (a - p).norm() < (b - p).norm();
  });
}

/// Poses from which the box and the pole stand free before the far wall.
const std::vector<Pose2> kViews = {{0.0, 0.0, 0.0},  {0.3, 0.3, -0.15}, {0.5, -0.5, 0.1},
                                   {0.0, 0.5, -0.1}, {0.2, -0.2, 0.05}, {0.6, 0.2, -0.1},
                                   {0.1, 0.1, 0.02}, {0.4, 0.0, -0.05}};

TEST(LandmarkDetector, FindsTheEdgesOfTheFurnitureAndNothingElse) {
  const SyntheticRoom room = furnished_room();
  std::size_t found = 0;
  for (const Pose2& pose : kViews) {
    const auto edges_m = true_edges_m(room, pose);
    const auto landmarks = detect(kinect_view(room, {}, pose, 7));
    found += landmarks.size();
    for (const Landmark& landmark : landmarks) {
      EXPECT_LT((nearest_m(edges_m, landmark) - position_m(landmark)).norm(), 0.10)
          << pose.x_m << " " << pose.y_m << " " << landmark.u_px;
    }
  }
  EXPECT_GE(found, 3u * 8u);  // a box's edges, left and right, and a pole in 8 views
}

TEST(LandmarkDetector, ErrorsFitTheirCovariance) {
  const SyntheticRoom room = furnished_room();
  double sum = 0.0;
  int count = 0;
  int lateral_small = 0;
  for (std::uint32_t seed = 0; seed < 3; ++seed) {
    for (const Pose2& pose : kViews) {
      const auto edges_m = true_edges_m(room, pose);
      for (const Landmark& landmark : detect(kinect_view(room, {}, pose, seed))) {
        if (!is_edge(landmark)) continue;
        const Eigen::Vector2d truth_m = nearest_m(edges_m, landmark);
        const Eigen::Vector2d error(
            landmark.range_m - truth_m.norm(),
            wrap_angle(landmark.bearing_rad - std::atan2(truth_m.y(), truth_m.x())));
        const double squared = error.dot(landmark.covariance.inverse() * error);
        EXPECT_LT(squared, 13.8);  // 99.9 % of chi-square with 2 degrees of freedom
        lateral_small += std::abs(error.y()) * landmark.range_m < 0.005 ? 1 : 0;
        sum += squared;
        ++count;
      }
    }
  }
  ASSERT_GT(count, 30);
  EXPECT_EQ(lateral_small, count);
  EXPECT_LT(sum / count, 2.0);  // the covariance holds bias too: errors are smaller, not larger
}

TEST(LandmarkDetector, SeesTheSameEdgeAtTheSamePlaceAgainAndAgain) {
  const SyntheticRoom room = furnished_room();
  std::vector<std::vector<Eigen::Vector2d>> seen(4);
  for (std::uint32_t seed = 0; seed < 12; ++seed) {
    const auto landmarks = detect(kinect_view(room, {}, {0.3, 0.1, -0.05}, seed));
    ASSERT_EQ(landmarks.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) seen[i].push_back(position_m(landmarks[i]));
  }
  for (const auto& places : seen) {
    Eigen::Vector2d mean(0.0, 0.0);
    for (const auto& p : places) mean += p / static_cast<double>(places.size());
    double squares = 0.0;
    for (const auto& p : places) squares += (p - mean).squaredNorm();
    EXPECT_LT(std::sqrt(squares / static_cast<double>(places.size())), 0.01);
  }
}

TEST(LandmarkDetector, EdgePixelsLieOnTrueDepthJumps) {
  SyntheticCamera exact;
  exact.noise_quanta = 0.0;
  exact.quantum_per_inverse_m = 1e6;
  const SyntheticRoom room = furnished_room();
  int right = 0;
  int found = 0;
  int findable = 0;
  for (const Pose2& pose : kViews) {
    const DepthImage truth = render(room, exact, pose, 0).depth;
    const auto jumps_at = [&](int u, int v) {
      if (u < 1 || u >= truth.width_px) return false;
      const double a = truth.at(u - 1, v) * 0.001;
      const double b = truth.at(u, v) * 0.001;
      const bool in_range = std::min(a, b) > 0.6 && std::max(a, b) < 4.08;
      return in_range && std::abs(a - b) > 0.07 && std::abs(1.0 / a - 1.0 / b) > 5.0 / kQuanta_m;
    };
    LandmarkDetector detector{LandmarkParams{}};
    ASSERT_EQ(detector.detect(kinect_view(room, {}, pose, 3)), DetectResult::kOk);
    for (const EdgePixel& edge : detector.edges()) {
      bool near_a_jump = false;
      for (int u = edge.u_px - 2; u <= edge.u_px + 3; ++u) near_a_jump |= jumps_at(u, edge.v_px);
      right += near_a_jump ? 1 : 0;
    }
    found += static_cast<int>(detector.edges().size());
    for (int v = 0; v < truth.height_px; ++v) {
      for (int u = 8; u < truth.width_px - 8; ++u) findable += jumps_at(u, v) ? 1 : 0;
    }
  }
  EXPECT_GT(found, 8 * 500);
  EXPECT_GT(right, 0.98 * found);
  EXPECT_GT(right, 0.90 * findable);
}

TEST(LandmarkDetector, ProjectingALandmarkBackHitsItsPixel) {
  SyntheticCamera tilted;
  tilted.pitch_rad = 0.2;
  const RgbdFrame frame = kinect_view(furnished_room(), tilted, {0.2, 0.0, 0.0}, 1);
  const auto landmarks = detect(frame);
  ASSERT_GE(landmarks.size(), 2u);
  for (const Landmark& landmark : landmarks) {
    const Eigen::Vector2d p = position_m(landmark);
    const double height_m = 0.5 * (landmark.height_low_m + landmark.height_high_m);
    const Eigen::Vector3d p_camera_m =
        frame.T_robot_camera.inverse() * Eigen::Vector3d(p.x(), p.y(), height_m);
    const double u =
        frame.depth_camera.cx_px + frame.depth_camera.fx_px * p_camera_m.x() / p_camera_m.z();
    const double v =
        frame.depth_camera.cy_px + frame.depth_camera.fy_px * p_camera_m.y() / p_camera_m.z();
    EXPECT_NEAR(u, landmark.u_px, 1.5);
    EXPECT_GT(v, landmark.v_top_px);
    EXPECT_LT(v, landmark.v_bottom_px);
  }
}

TEST(LandmarkDetector, MirrorSwapsLeftAndRight) {
  for (const Pose2& pose : kViews) {
    const RgbdFrame frame = kinect_view(furnished_room(), {}, pose, 5);
    const auto seen = detect(frame);
    auto in_mirror = detect(mirrored(frame));
    std::reverse(in_mirror.begin(), in_mirror.end());
    ASSERT_EQ(seen.size(), in_mirror.size());
    for (std::size_t i = 0; i < seen.size(); ++i) {
      EXPECT_EQ(seen[i].kind == in_mirror[i].kind, !is_edge(seen[i]));
      const double tolerance = is_edge(seen[i]) ? 1e-9 : 1e-6;  // the scan is in single precision
      EXPECT_NEAR(seen[i].range_m, in_mirror[i].range_m, tolerance);
      EXPECT_NEAR(seen[i].bearing_rad, -in_mirror[i].bearing_rad, tolerance);
      EXPECT_NEAR(seen[i].covariance(0, 1), -in_mirror[i].covariance(0, 1), 1e-3 * tolerance);
      EXPECT_NEAR(seen[i].chroma.red_log, in_mirror[i].chroma.red_log, 1e-12);
    }
  }
}

TEST(LandmarkDetector, CameraMovedOnTheRobotMovesLandmarksWithIt) {
  RgbdFrame frame = kinect_view(furnished_room(), {}, {0.2, 0.0, 0.0}, 1);
  const auto before = without_creases(detect(frame));
  Eigen::Isometry3d shift = Eigen::Isometry3d::Identity();
  shift.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()));
  shift.pretranslate(Eigen::Vector3d(0.3, -0.2, 0.1));
  frame.T_robot_camera = shift * frame.T_robot_camera;
  const auto after = without_creases(detect(frame));
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Eigen::Vector2d p = position_m(before[i]);
    const Eigen::Vector2d moved = (shift * Eigen::Vector3d(p.x(), p.y(), 0.0)).head<2>();
    EXPECT_NEAR((position_m(after[i]) - moved).norm(), 0.0, 1e-9);
    EXPECT_NEAR(after[i].height_high_m, before[i].height_high_m + 0.1, 1e-9);
  }
}

TEST(LandmarkDetector, DarknessTakesTheColorButNoLandmark) {
  RgbdFrame frame = kinect_view(furnished_room(), {}, {0.2, 0.0, 0.0}, 1);
  const auto lit = detect(frame);
  for (std::uint8_t& level : frame.color.rgb) level = static_cast<std::uint8_t>(level / 20);
  const auto dark = detect(frame);
  ASSERT_EQ(lit.size(), dark.size());
  for (std::size_t i = 0; i < lit.size(); ++i) {
    EXPECT_EQ(lit[i].range_m, dark[i].range_m);
    if (!is_crease(lit[i])) {
      EXPECT_LT(lit[i].chroma.variance_log2, 0.05);
    }
    EXPECT_EQ(dark[i].chroma.variance_log2, ChromaSignature::kNoColorVariance_log2);
  }
}

TEST(LandmarkDetector, WorksAtEverySize) {
  for (const int width_px : {160, 320, 640, 1280}) {
    SyntheticCamera camera;
    camera.width_px = width_px;
    camera.height_px = width_px * 3 / 4;
    const auto edges_m = true_edges_m(furnished_room(), {});
    const auto landmarks = detect(kinect_view(furnished_room(), camera, {}, 2));
    EXPECT_GE(landmarks.size(), 2u) << width_px;
    for (const Landmark& landmark : landmarks) {
      EXPECT_LT((nearest_m(edges_m, landmark) - position_m(landmark)).norm(), 0.06) << width_px;
    }
  }
}

TEST(LandmarkDetector, ThesisMethodSeesTheFurnitureToo) {
  LandmarkParams params;
  params.method = "thesis";
  params.slope.threshold_mm_per_px = 300.0;
  SyntheticCamera camera;
  camera.noise_quanta = 0.0;
  const RgbdFrame frame = render(furnished_room(), camera, {}, 0);
  EXPECT_GE(detect(frame, params).size(), 2u);
}

TEST(LandmarkDetector, ThesisWeightOfColorFollowsTheLight) {
  LandmarkParams params;
  params.method = "thesis";
  LandmarkDetector detector(params);
  RgbdFrame frame = render(furnished_room(), {}, {}, 0);
  ASSERT_EQ(detector.detect(frame), DetectResult::kOk);
  EXPECT_EQ(detector.alpha_ratio(), params.color.alpha_max_ratio);
  std::fill(frame.color.rgb.begin(), frame.color.rgb.end(), std::uint8_t{10});
  ASSERT_EQ(detector.detect(frame), DetectResult::kOk);
  EXPECT_EQ(detector.alpha_ratio(), 0.0);
}

TEST(LandmarkDetector, NothingToSeeGivesNothing) {
  RgbdFrame frame = render(furnished_room(), {}, {}, 0);
  for (const int step : {0, 1, 2000, 4096, 65535}) {
    std::fill(frame.depth.steps.begin(), frame.depth.steps.end(), static_cast<std::uint16_t>(step));
    EXPECT_TRUE(detect(frame).empty()) << step;
  }
}

TEST(LandmarkDetector, BadFramesAreRefusedAndLeaveTheResultsAsTheyWere) {
  LandmarkDetector detector{LandmarkParams{}};
  const RgbdFrame good = kinect_view(furnished_room(), {}, {}, 0);
  ASSERT_EQ(detector.detect(good), DetectResult::kOk);
  const std::size_t count = detector.landmarks().size();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  RgbdFrame bad = good;
  bad.depth.steps.pop_back();
  EXPECT_EQ(detector.detect(bad), DetectResult::kBadImage);
  EXPECT_EQ(detector.detect(RgbdFrame{}), DetectResult::kBadImage);
  bad = good;
  bad.depth.unit_m = -0.001;
  EXPECT_EQ(detector.detect(bad), DetectResult::kBadUnit);
  bad = good;
  bad.depth_camera.fx_px = 0.0;
  EXPECT_EQ(detector.detect(bad), DetectResult::kBadCamera);
  bad = good;
  bad.depth_camera.cy_px = nan;
  EXPECT_EQ(detector.detect(bad), DetectResult::kBadCamera);
  bad = good;
  bad.T_robot_camera.translation().x() = nan;
  EXPECT_EQ(detector.detect(bad), DetectResult::kBadPose);
  EXPECT_EQ(detector.landmarks().size(), count);
}

/// Numbers a broken calibration or a hostile sender might hold.
double any_number() {
  return *rc::gen::element(0.0, 1.0, -1.0, 1e-300, 1e300, -1e300, 1e-6, 1e6, 585.0, 0.001, 3.0);
}

RC_GTEST_PROP(LandmarkDetector, EverythingItSaysIsFiniteWhateverItIsFed, ()) {
  static const RgbdFrame furnished = kinect_view(furnished_room(), {}, {}, 0);
  RgbdFrame frame = furnished;
  frame.depth.unit_m = *rc::gen::element(0.001, 0.0005, 0.1, 1e-9, 1e300);
  frame.depth_camera = {any_number(), any_number(), any_number(), any_number()};
  for (int i = 0; i < 12; ++i) {
    if (*rc::gen::inRange(0, 3) == 0) frame.T_robot_camera.matrix()(i % 3, i / 3) = any_number();
  }
  LandmarkDetector detector{LandmarkParams{}};
  if (detector.detect(frame) != DetectResult::kOk) return;
  for (const Landmark& landmark : detector.landmarks()) {
    RC_ASSERT(std::isfinite(landmark.range_m) && landmark.range_m > 0.0);
    RC_ASSERT(std::abs(landmark.bearing_rad) <= 3.1416 && landmark.covariance.allFinite());
    RC_ASSERT(std::isfinite(landmark.height_low_m) && std::isfinite(landmark.height_high_m));
    RC_ASSERT(std::isfinite(landmark.step_m) && std::isfinite(landmark.u_px));
    RC_ASSERT(landmark.score_ratio >= 0.0 && landmark.score_ratio <= 1.0);
  }
}

/// Places that are no numbers: a search among them once ran past the end of the scan.
TEST(LandmarkDetector, AbsurdCamerasAreLookedThroughToTheEnd) {
  RgbdFrame frame = kinect_view(furnished_room(), {}, {}, 0);
  const Eigen::Isometry3d mounted = frame.T_robot_camera;
  LandmarkDetector detector{LandmarkParams{}};
  for (const double fx_px : {1e-300, 1e-306, 1e300}) {
    for (const double cx_px : {0.0, 1.0, 319.5, 585.0, 1e300}) {
      frame.depth_camera.fx_px = fx_px;
      frame.depth_camera.cx_px = cx_px;
      for (int i = 0; i < 12; ++i) {
        for (const double number : {0.0, 1e-6, 1.0, -1.0, 1e300, -1e300}) {
          frame.T_robot_camera = mounted;
          frame.T_robot_camera.matrix()(i % 3, i / 3) = number;
          (void)detector.detect(frame);
          for (const Landmark& landmark : detector.landmarks()) {
            EXPECT_TRUE(std::isfinite(landmark.range_m));
          }
        }
      }
    }
  }
}

TEST(LandmarkDetector, MaximumClutterStaysWithinItsBudget) {
  RgbdFrame frame = render(furnished_room(), {}, {}, 0);
  for (std::size_t i = 0; i < frame.depth.steps.size(); ++i) {
    frame.depth.steps[i] = i % 8 < 4 ? std::uint16_t{1000} : std::uint16_t{3000};
  }
  LandmarkParams params;
  params.jump.near_run_px = 4;  // as short as anything can be
  params.landmarks_max = 2;
  LandmarkDetector detector(params);
  ASSERT_EQ(detector.detect(frame), DetectResult::kOk);
  EXPECT_GT(detector.edges().size(), frame.depth.size() / 5);
  EXPECT_EQ(detector.landmarks().size(), 2u);
  EXPECT_GT(detector.rejected().of(RejectReason::kLandmarkOverBudget), 0);
}

TEST(LandmarkDetector, SameFrameSameBits) {
  const RgbdFrame frame = kinect_view(furnished_room(), {}, {}, 4);
  LandmarkDetector detector{LandmarkParams{}};
  ASSERT_EQ(detector.detect(frame), DetectResult::kOk);
  const auto first = detector.landmarks();
  ASSERT_EQ(detector.detect(render(furnished_room(), {}, {0.5, 0.0, 0.3}, 1)), DetectResult::kOk);
  ASSERT_EQ(detector.detect(frame), DetectResult::kOk);
  ASSERT_EQ(first.size(), detector.landmarks().size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].range_m, detector.landmarks()[i].range_m);
    EXPECT_EQ(first[i].bearing_rad, detector.landmarks()[i].bearing_rad);
    EXPECT_EQ(first[i].covariance, detector.landmarks()[i].covariance);
  }
}

TEST(LandmarkDetector, RangesTheWrongWayRoundRefuseToStart) {
  LandmarkParams params;
  params.jump.range_min_m = 4.0;
  EXPECT_THROW(LandmarkDetector{params}, std::runtime_error);
}

}  // namespace
}  // namespace roomwise::landmark
