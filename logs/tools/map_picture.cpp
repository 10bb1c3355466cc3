#include "logs/tools/map_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "logs/tools/canvas.h"
#include "logs/tools/map_scene.h"

namespace roomwise {
namespace {

constexpr Color kGrid{232, 234, 236};
constexpr Color kFaintInk{132, 136, 140};
constexpr Color kTruth{40, 160, 90};
constexpr Color kOdometry{250, 150, 60};
constexpr Color kEstimate{20, 90, 200};
constexpr Color kLandmark{205, 40, 60};

constexpr int kPictureWidth_px = 1400;
constexpr int kPictureHeight_px = 1000;
const cv::Rect2d kPlot{40.0, 90.0, 1060.0, 870.0};

/// From the world (y up) to the picture (y down).
class View {
 public:
  explicit View(const MapBounds& bounds) {
    constexpr double kBorder_px = 45.0;
    constexpr double kSmallest_m = 0.5;
    const Eigen::Vector2d size_m = bounds.size_m().cwiseMax(kSmallest_m);
    scale_px_per_m_ = std::min((kPlot.width - 2 * kBorder_px) / size_m.x(),
                               (kPlot.height - 2 * kBorder_px) / size_m.y());
    centre_m_ = 0.5 * (bounds.low_m + bounds.high_m);
  }

  cv::Point2d pixel(const Eigen::Vector2d& p_m) const {
    const Eigen::Vector2d d_px = (p_m - centre_m_) * scale_px_per_m_;
    return {kPlot.x + kPlot.width / 2 + d_px.x(), kPlot.y + kPlot.height / 2 - d_px.y()};
  }

  /// Points closer than half a pixel to the one before are left out.
  std::vector<cv::Point2d> pixels(const Points2& points) const {
    std::vector<cv::Point2d> path;
    for (const Eigen::Vector2d& p_m : points) {
      const cv::Point2d next = pixel(p_m);
      if (path.empty() || cv::norm(next - path.back()) > 0.5) path.push_back(next);
    }
    return path;
  }

  double scale_px_per_m() const { return scale_px_per_m_; }

  /// 1, 2 or 5 times a power of ten, some 120 px long.
  double round_length_m() const {
    const double wanted_m = 120.0 / scale_px_per_m_;
    const double power = std::pow(10.0, std::floor(std::log10(wanted_m)));
    const double digit = wanted_m / power;
    return power * (digit < 1.5 ? 1.0 : digit < 3.5 ? 2.0 : digit < 7.5 ? 5.0 : 10.0);
  }

 private:
  double scale_px_per_m_ = 0.0;
  Eigen::Vector2d centre_m_;
};

void draw_grid(Canvas& canvas, const View& view) {
  const double step_px = view.round_length_m() * view.scale_px_per_m();
  const cv::Point2d origin = view.pixel(Eigen::Vector2d::Zero());
  const auto first = [step_px](double origin_px, double low_px) {
    return origin_px + step_px * std::ceil((low_px - origin_px) / step_px);
  };
  for (double x = first(origin.x, kPlot.x); x < kPlot.br().x; x += step_px) {
    canvas.line({x, kPlot.y}, {x, kPlot.br().y}, kGrid, 1.0);
  }
  for (double y = first(origin.y, kPlot.y); y < kPlot.br().y; y += step_px) {
    canvas.line({kPlot.x, y}, {kPlot.br().x, y}, kGrid, 1.0);
  }
}

void draw_ellipse(Canvas& canvas, const View& view, const Points2& ellipse) {
  std::vector<cv::Point2d> outline;
  for (const Eigen::Vector2d& p_m : ellipse) outline.push_back(view.pixel(p_m));
  if (outline.empty()) return;
  canvas.polygon(outline, kLandmark, 0.18);
  outline.push_back(outline.front());
  canvas.polyline(outline, kLandmark, 1.3);
}

void draw_identity(Canvas& canvas, const View& view, const MapPoint& landmark) {
  if (landmark.identity < 0) return;
  const cv::Point2d start = view.pixel(landmark.p_m) + cv::Point2d(8.0, -7.0);
  canvas.outlined_text(start, fmt::format("{}", landmark.identity), 9.0, kInk, kPaper);
}

void draw_landmarks(Canvas& canvas, const View& view, const MapScene& scene) {
  for (const Points2& ellipse : scene.ellipses) draw_ellipse(canvas, view, ellipse);
  for (const MapPoint& landmark : scene.true_landmarks) {
    canvas.cross(view.pixel(landmark.p_m), 7.0, kInk, 1.5);
  }
  for (const MapPoint& landmark : scene.landmarks) {
    canvas.disc(view.pixel(landmark.p_m), 3.0, kLandmark);
  }
  const bool mapped = !scene.landmarks.empty();
  for (const MapPoint& landmark : mapped ? scene.landmarks : scene.true_landmarks) {
    draw_identity(canvas, view, landmark);
  }
}

void draw_start(Canvas& canvas, const View& view, const Points2& path) {
  if (path.empty()) return;
  canvas.disc(view.pixel(path.front()), 6.0, kInk);
  canvas.disc(view.pixel(path.front()), 3.5, kPaper);
}

void draw_scale_bar(Canvas& canvas, const View& view) {
  const double length_m = view.round_length_m();
  const double length_px = length_m * view.scale_px_per_m();
  const cv::Point2d left(kPlot.x + 24.0, kPlot.br().y - 24.0);
  const cv::Point2d right(left.x + length_px, left.y);
  const std::string words = fmt::format("{} m", length_m);
  canvas.rectangle({left.x - 12, left.y - 34, length_px + 24, 48}, kPaper, 0.85);
  canvas.line(left, right, kInk, 2.0);
  for (const cv::Point2d& end : {left, right}) {
    canvas.line({end.x, end.y - 6}, {end.x, end.y + 6}, kInk, 2.0);
  }
  canvas.text({(left.x + right.x - Canvas::text_width_px(words, 12)) / 2, left.y - 12}, words, 12,
              kInk);
}

void draw_scene(Canvas& canvas, const View& view, const MapScene& scene) {
  canvas.clip(kPlot);
  draw_grid(canvas, view);
  canvas.polyline(view.pixels(scene.odometry), kOdometry, 1.0);
  canvas.polyline(view.pixels(scene.truth), kTruth, 2.2);
  canvas.polyline(view.pixels(scene.estimate), kEstimate, 1.2);
  draw_start(canvas, view, scene.start_path());
  draw_landmarks(canvas, view, scene);
  draw_scale_bar(canvas, view);
  canvas.unclip();
}

/// Draws a row of the legend and steps down; nothing if there is nothing of the kind.
class Legend {
 public:
  explicit Legend(Canvas& canvas) : canvas_(canvas) {}

  void path(const Points2& points, Color color, double width_px, const std::string& words) {
    if (points.empty()) return;
    canvas_.line({kLeft_px, y_px_}, {kLeft_px + 34, y_px_}, color, width_px);
    row(words);
  }
  void landmarks(std::size_t count) {
    if (count == 0) return;
    const cv::Point2d centre(kLeft_px + 17, y_px_);
    canvas_.rectangle({centre.x - 15, centre.y - 9, 30, 18}, kLandmark, 0.18);
    canvas_.disc(centre, 3.0, kLandmark);
    row(fmt::format("{} landmarks, 95 %", count));
  }
  void true_landmarks(std::size_t count) {
    if (count == 0) return;
    canvas_.cross({kLeft_px + 17, y_px_}, 7.0, kInk, 1.5);
    row(fmt::format("{} true landmarks", count));
  }
  void start(const Points2& path) {
    if (path.empty()) return;
    canvas_.disc({kLeft_px + 17, y_px_}, 6.0, kInk);
    canvas_.disc({kLeft_px + 17, y_px_}, 3.5, kPaper);
    row("start");
  }

 private:
  void row(const std::string& words) {
    canvas_.text({kLeft_px + 48, y_px_ + 6}, words, 12, kInk);
    y_px_ += 34;
  }
  static constexpr double kLeft_px = 1122;
  Canvas& canvas_;
  double y_px_ = 116;
};

void draw_frame(Canvas& canvas, const MapScene& scene, const std::string& title) {
  const cv::Point2d a = kPlot.tl();
  const cv::Point2d b = kPlot.br();
  canvas.polyline({a, {b.x, a.y}, b, {a.x, b.y}, a}, kFaintInk, 1.0);
  canvas.text({kPlot.x, 44}, title, 18, kInk);
  canvas.text({kPlot.x, 74}, scene.caption, 12, kFaintInk);
  Legend legend(canvas);
  legend.path(scene.truth, kTruth, 2.2, "true path");
  legend.path(scene.odometry, kOdometry, 1.0, "odometry alone");
  legend.path(scene.estimate, kEstimate, 1.2, "estimated path");
  legend.landmarks(scene.landmarks.size());
  legend.true_landmarks(scene.true_landmarks.size());
  legend.start(scene.start_path());
}

}  // namespace

cv::Mat3b draw_map(const Recording& recording, const std::string& title) {
  const MapScene scene = map_scene_of(recording);
  const MapBounds bounds = map_bounds(scene);
  if (bounds.empty()) {
    throw std::runtime_error("nothing to draw: needs POSE, ODOMETRY, TRUTH or LANDMARK_MAP");
  }
  Canvas canvas(kPictureWidth_px, kPictureHeight_px, kPaper);
  draw_scene(canvas, View(bounds), scene);
  draw_frame(canvas, scene, title);
  return canvas.finish();
}

}  // namespace roomwise
