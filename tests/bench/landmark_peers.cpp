// How often the landmarks of each method are seen again, on frames whose camera poses are known;
// scripts/experiments landmark_peers reads the lines:
//   METHOD A_FRAME SEEN_AGAIN SPREAD_m MS_A_FRAME
//
// A place seen in one frame should be seen again in the frame half a second later if it is well
// inside that one's view; it is if a place of the later frame lies within 5 cm, all in the world.
// For ORB that must be the keypoint whose descriptor matches. Spread: RMS of their distance. Edge
// pictures become places by upright_edges_m, which is not timed, nor is making PCL's point cloud.
//
// usage: landmark_peers LOG     with KINECT_FRAME and TRUTH
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <vector>

#include "common/bus/log_file.h"
#include "common/channels.h"
#include "common/frames/frame_decoder.h"
#include "services/landmark_svc/core/landmark_detector.h"
#include "tests/bench/upright_edges.h"
#ifdef ROOMWISE_HAVE_PCL
#include <pcl/features/organized_edge_detection.h>
#include <pcl/point_types.h>
#endif

namespace roomwise {
namespace {

constexpr std::int64_t kLater_us = 500'000;
constexpr double kSamePlace_m = 0.05;
constexpr double kNearest_m = 0.8;
constexpr double kFarthest_m = 3.6;
constexpr double kViewHalfAngle_rad = 0.40;

/// What a method found in one frame.
struct View {
  std::int64_t utime = 0;
  Pose2 T_world_robot;
  std::vector<Eigen::Vector2d> places_m;  // world
  cv::Mat descriptors;                    // as many rows, or none
};

class Method {
 public:
  virtual ~Method() = default;
  /// Fills places_m in the robot frame, and descriptors if it has any; the seconds it took.
  virtual double find(const RgbdFrame& frame, View& view) = 0;
};

double timed_s(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

class Roomwise : public Method {
 public:
  explicit Roomwise(const landmark::LandmarkParams& params) : detector_(params) {}

  double find(const RgbdFrame& frame, View& view) override {
    const double took_s = timed_s([&] { (void)detector_.detect(frame); });
    for (const landmark::Landmark& seen : detector_.landmarks()) {
      view.places_m.emplace_back(seen.range_m * std::cos(seen.bearing_rad),
                                 seen.range_m * std::sin(seen.bearing_rad));
    }
    return took_s;
  }

 private:
  landmark::LandmarkDetector detector_;
};

class Canny : public Method {
 public:
  double find(const RgbdFrame& frame, View& view) override {
    const DepthImage& depth = frame.depth;
    cv::Mat image(depth.height_px, depth.width_px, CV_8U);  // 16 mm a level
    for (std::size_t i = 0; i < depth.size(); ++i) {
      image.data[i] = static_cast<std::uint8_t>(std::min(depth.steps[i] / 16, 255));
    }
    cv::Mat edges;
    const double took_s = timed_s([&] { cv::Canny(image, edges, 20.0, 60.0); });
    view.places_m = upright_edges_m(edges, frame);
    return took_s;
  }
};

#ifdef ROOMWISE_HAVE_PCL
/// Its occluding edges: the near sides, as ours are. Parameters as they come.
class OrganizedEdges : public Method {
 public:
  double find(const RgbdFrame& frame, View& view) override {
    pcl::OrganizedEdgeBase<pcl::PointXYZ, pcl::Label> detector;
    detector.setInputCloud(cloud_of(frame));
    pcl::PointCloud<pcl::Label> labels;
    std::vector<pcl::PointIndices> found;
    const double took_s = timed_s([&] { detector.compute(labels, found); });
    cv::Mat edges = cv::Mat::zeros(frame.depth.height_px, frame.depth.width_px, CV_8U);
    for (const int pixel : found.at(1).indices) edges.data[pixel] = 255;
    view.places_m = upright_edges_m(edges, frame);
    return took_s;
  }

 private:
  static pcl::PointCloud<pcl::PointXYZ>::Ptr cloud_of(const RgbdFrame& frame) {
    const DepthImage& depth = frame.depth;
    const PinholeCamera& camera = frame.depth_camera;
    auto cloud = std::make_shared<pcl::PointCloud<pcl::PointXYZ>>(depth.width_px, depth.height_px);
    cloud->is_dense = false;
    for (int v = 0; v < depth.height_px; ++v) {
      for (int u = 0; u < depth.width_px; ++u) {
        const double z_m = depth.at(u, v) == 0 ? std::nan("") : depth.at(u, v) * depth.unit_m;
        cloud->at(u, v) = {static_cast<float>((u - camera.cx_px) / camera.fx_px * z_m),
                           static_cast<float>((v - camera.cy_px) / camera.fy_px * z_m),
                           static_cast<float>(z_m)};
      }
    }
    return cloud;
  }
};
#endif

/// Keypoints of the colour image, 1000 at most, where the depth image has a reading.
class Orb : public Method {
 public:
  double find(const RgbdFrame& frame, View& view) override {
    const ColorImage& color = frame.color;
    if (color.rgb.empty()) return 0.0;
    cv::Mat grey;
    cv::cvtColor(cv::Mat(color.height_px, color.width_px, CV_8UC3,
                         const_cast<std::uint8_t*>(color.rgb.data())),
                 grey, cv::COLOR_RGB2GRAY);
    std::vector<cv::KeyPoint> points;
    cv::Mat all;
    cv::Mat before = last_;
    std::vector<cv::DMatch> matches;
    const double took_s = timed_s([&] {
      orb_->detectAndCompute(grey, cv::noArray(), points, all);
      if (!before.empty()) matcher_.match(all, before, matches);
    });
    last_ = all.clone();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (const auto place_m = place_of(frame, points[i].pt)) {
        view.places_m.push_back(*place_m);
        view.descriptors.push_back(all.row(static_cast<int>(i)));
      }
    }
    return took_s;
  }

 private:
  static std::optional<Eigen::Vector2d> place_of(const RgbdFrame& frame, const cv::Point2f& at) {
    const DepthImage& depth = frame.depth;
    const int u = static_cast<int>(at.x) * depth.width_px / frame.color.width_px;
    const int v = static_cast<int>(at.y) * depth.height_px / frame.color.height_px;
    if (depth.at(u, v) == 0) return std::nullopt;
    const PinholeCamera& camera = frame.depth_camera;
    const double z_m = depth.at(u, v) * depth.unit_m;
    const Eigen::Vector3d p_camera_m((u - camera.cx_px) / camera.fx_px * z_m,
                                     (v - camera.cy_px) / camera.fy_px * z_m, z_m);
    return Eigen::Vector2d((frame.T_robot_camera * p_camera_m).head<2>());
  }

  cv::Ptr<cv::ORB> orb_ = cv::ORB::create(1000);
  cv::BFMatcher matcher_{cv::NORM_HAMMING, true};
  cv::Mat last_;
};

/// The later view's place that is the same thing as place `k` of the earlier one; negative: none.
using Partners = std::vector<int>;

Partners nearest_places(const View& earlier, const View& later) {
  Partners partners(earlier.places_m.size(), -1);
  for (std::size_t k = 0; k < partners.size(); ++k) {
    double nearest_m = kSamePlace_m;
    for (std::size_t j = 0; j < later.places_m.size(); ++j) {
      const double away_m = (later.places_m[j] - earlier.places_m[k]).norm();
      if (away_m > nearest_m) continue;
      nearest_m = away_m;
      partners[k] = static_cast<int>(j);
    }
  }
  return partners;
}

Partners matching_descriptors(const View& earlier, const View& later) {
  Partners partners(earlier.places_m.size(), -1);
  if (earlier.descriptors.empty() || later.descriptors.empty()) return partners;
  std::vector<cv::DMatch> matches;
  cv::BFMatcher(cv::NORM_HAMMING, true).match(earlier.descriptors, later.descriptors, matches);
  for (const cv::DMatch& match : matches) {
    partners[static_cast<std::size_t>(match.queryIdx)] = match.trainIdx;
  }
  return partners;
}

bool is_well_in_view(const Pose2& T_world_robot, const Eigen::Vector2d& p_world_m) {
  const Eigen::Vector2d p_m = transform(inverse(T_world_robot), p_world_m);
  return p_m.norm() > kNearest_m && p_m.norm() < kFarthest_m &&
         std::abs(std::atan2(p_m.y(), p_m.x())) < kViewHalfAngle_rad;
}

/// What one method did over the log.
class Tally {
 public:
  explicit Tally(std::unique_ptr<Method> method) : method_(std::move(method)) {}

  void look(const RgbdFrame& frame, const Pose2& T_world_robot) {
    View view;
    view.utime = frame.utime;
    view.T_world_robot = T_world_robot;
    took_s_ += method_->find(frame, view);
    for (Eigen::Vector2d& place_m : view.places_m) place_m = transform(T_world_robot, place_m);
    frames_ += 1.0;
    places_ += static_cast<double>(view.places_m.size());
    views_.push_back(std::move(view));
    while (views_.back().utime - views_.front().utime >= kLater_us) {
      compare(views_.front(), views_.back());
      views_.pop_front();
    }
  }

  void print(const char* name) const {
    fmt::print("{} {:.2f} {:.3f} {:.4f} {:.3f}\n", name, places_ / frames_, again_ / expected_,
               std::sqrt(squares_m2_ / again_), 1e3 * took_s_ / frames_);
  }

 private:
  void compare(const View& earlier, const View& later) {
    const Partners partners = earlier.descriptors.empty() ? nearest_places(earlier, later)
                                                          : matching_descriptors(earlier, later);
    for (std::size_t k = 0; k < partners.size(); ++k) {
      if (!is_well_in_view(later.T_world_robot, earlier.places_m[k])) continue;
      expected_ += 1.0;
      if (partners[k] < 0) continue;
      const auto& partner_m = later.places_m[static_cast<std::size_t>(partners[k])];
      const double away_m = (partner_m - earlier.places_m[k]).norm();
      if (away_m > kSamePlace_m) continue;
      again_ += 1.0;
      squares_m2_ += away_m * away_m;
    }
  }

  std::unique_ptr<Method> method_;
  std::deque<View> views_;  // of the last half second
  double frames_ = 0.0;
  double took_s_ = 0.0;
  double places_ = 0.0;
  double expected_ = 0.0;
  double again_ = 0.0;
  double squares_m2_ = 0.0;
};

/// Where the robot was, by the time.
std::map<std::int64_t, Pose2> true_poses(const char* path) {
  LogReader log(path);
  LogEvent event;
  truth_t message;
  std::map<std::int64_t, Pose2> poses;
  while (log.next(event)) {
    if (event.channel != channels::kTruth.name) continue;
    if (decode(event.data, message) != DecodeResult::kOk) throw std::runtime_error("bad TRUTH");
    poses[message.utime] = {message.true_x_m, message.true_y_m, message.true_heading_rad};
  }
  return poses;
}

struct Contestant {
  const char* name;
  Tally tally;
};

std::vector<Contestant> contestants() {
  landmark::LandmarkParams thesis;
  thesis.method = "thesis";
  std::vector<Contestant> all;
  all.push_back({"roomwise", Tally(std::make_unique<Roomwise>(landmark::LandmarkParams{}))});
  all.push_back({"thesis", Tally(std::make_unique<Roomwise>(thesis))});
  all.push_back({"canny", Tally(std::make_unique<Canny>())});
#ifdef ROOMWISE_HAVE_PCL
  all.push_back({"pcl", Tally(std::make_unique<OrganizedEdges>())});
#endif
  all.push_back({"orb", Tally(std::make_unique<Orb>())});
  return all;
}

void compare(const char* path) {
  cv::setNumThreads(1);
  const auto poses = true_poses(path);
  std::vector<Contestant> all = contestants();
  LogReader log(path);
  LogEvent event;
  kinect_frame_t message;
  FrameDecoder decoder(ColorUse::kDecode);
  RgbdFrame frame;
  while (log.next(event)) {
    if (event.channel != channels::kKinectFrame.name) continue;
    if (decode(event.data, message) != DecodeResult::kOk ||
        decoder.decode(message, frame) != FrameResult::kOk) {
      throw std::runtime_error("a frame cannot be decoded");
    }
    const auto pose = poses.lower_bound(frame.utime);
    if (pose == poses.end()) break;
    for (Contestant& each : all) each.tally.look(frame, pose->second);
  }
  for (const Contestant& each : all) each.tally.print(each.name);
}

}  // namespace
}  // namespace roomwise

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: landmark_peers LOG\n");
    return EXIT_FAILURE;
  }
  try {
    roomwise::compare(argv[1]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "landmark_peers: {}\n", error.what());
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
