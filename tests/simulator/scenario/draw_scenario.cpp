// Draws a scenario from above: solids by height, holes, walkers' ways, landmarks, the loop.
// usage: draw_scenario FILE.toml OUT.png
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "services/simulator/scenario/scenario.h"

namespace roomwise::simulator {
namespace {

constexpr double kMargin_m = 0.5;

class Drawing {
 public:
  explicit Drawing(const Scene& scene) {
    bounds_.extend(scene.start.position_m());
    for (const Block& block : scene.blocks) {
      if (!block.has_landmarks) continue;
      for (const Eigen::Vector2d& corner : block.corners_m) bounds_.extend(corner);
    }
    for (const Path& path : scene.paths) {
      for (const Eigen::Vector2d& corner : path.corners_m) bounds_.extend(corner);
    }
    const Eigen::Vector2d size_m = bounds_.sizes() + Eigen::Vector2d::Constant(2 * kMargin_m);
    scale_ = 1400.0 / size_m.maxCoeff();
    picture_ = cv::Mat(static_cast<int>(size_m.y() * scale_), static_cast<int>(size_m.x() * scale_),
                       CV_8UC3, cv::Scalar(255, 255, 255));
  }

  cv::Point at(const Eigen::Vector2d& p_m) const {
    const Eigen::Vector2d q = (p_m - bounds_.min()).array() + kMargin_m;
    return {static_cast<int>(std::lround(q.x() * scale_)),
            picture_.rows - static_cast<int>(std::lround(q.y() * scale_))};
  }
  void polygon(const std::vector<Eigen::Vector2d>& corners_m, const cv::Scalar& fill,
               const cv::Scalar& outline) {
    std::vector<cv::Point> points;
    for (const Eigen::Vector2d& corner : corners_m) points.push_back(at(corner));
    cv::fillPoly(picture_, points, fill, cv::LINE_AA);
    cv::polylines(picture_, points, true, outline, 1, cv::LINE_AA);
  }
  void line(const Eigen::Vector2d& a_m, const Eigen::Vector2d& b_m, const cv::Scalar& color,
            int width_px) {
    cv::line(picture_, at(a_m), at(b_m), color, width_px, cv::LINE_AA);
  }
  void disc(const Eigen::Vector2d& p_m, double radius_m, const cv::Scalar& color, int width_px) {
    cv::circle(picture_, at(p_m), std::max(1, static_cast<int>(radius_m * scale_)), color, width_px,
               cv::LINE_AA);
  }
  void dot(const Eigen::Vector2d& p_m, const cv::Scalar& color) {
    cv::circle(picture_, at(p_m), 4, color, cv::FILLED, cv::LINE_AA);
  }
  const cv::Mat& picture() const { return picture_; }

 private:
  Eigen::AlignedBox2d bounds_;
  double scale_ = 100.0;
  cv::Mat picture_;
};

cv::Scalar shade(double low_m, double high_m) {
  if (high_m <= 0.0) return {230, 200, 230};
  const double grey = low_m > 0.12 ? 235.0 : 220.0 - 70.0 * std::min(high_m, 2.5);
  return {grey, grey, grey};
}

void draw_solids(Drawing& drawing, const Scene& scene) {
  for (const Pit& pit : scene.pits) drawing.polygon(pit.corners_m, {160, 60, 160}, {80, 0, 80});
  std::vector<Block> blocks = scene.blocks;  // what hangs over the floor first
  std::stable_sort(blocks.begin(), blocks.end(),
                   [](const Block& a, const Block& b) { return a.low_m > b.low_m; });
  for (const Block& block : blocks) {
    drawing.polygon(block.corners_m, shade(block.low_m, block.high_m),
                    block.has_landmarks ? cv::Scalar(60, 60, 60) : cv::Scalar(220, 160, 0));
  }
  for (const Column& column : scene.columns) {
    drawing.disc(column.center_m, column.radius_m, shade(column.low_m, column.high_m),
                 column.low_m > 0.12 ? 1 : cv::FILLED);
  }
}

void draw_ways(Drawing& drawing, const Scene& scene) {
  for (const Walker& walker : scene.walkers) {
    for (std::size_t i = 0; i < walker.way_m.size(); ++i) {
      drawing.line(walker.way_m[i], walker.way_m[(i + 1) % walker.way_m.size()], {0, 140, 255}, 1);
    }
    drawing.disc(walker_pose(walker, 0.0).position_m(), walker.radius_m, {0, 140, 255}, 2);
  }
  drawing.disc(scene.start.position_m(), 0.17, {0, 160, 0}, 2);
  const Path* loop = find_path(scene, "loop1");
  if (loop == nullptr) return;
  Eigen::Vector2d before_m = scene.start.position_m();
  for (const Eigen::Vector2d& corner : loop->corners_m) {
    drawing.line(before_m, corner, {0, 160, 0}, 2);
    before_m = corner;
  }
  drawing.line(before_m, scene.start.position_m(), {0, 160, 0}, 2);
}

void draw_landmarks(Drawing& drawing, const Scene& scene) {
  for (const SceneLandmark& landmark : scene.landmarks) {
    const cv::Scalar color = landmark.kind == 3   ? cv::Scalar(0, 0, 220)
                             : landmark.kind == 4 ? cv::Scalar(220, 80, 0)
                                                  : cv::Scalar(0, 180, 220);
    drawing.dot(landmark.position_m, color);
  }
}

void draw(const std::string& scenario, const std::string& picture) {
  const Scene scene = load_scenario(scenario).scene;
  Drawing drawing(scene);
  draw_solids(drawing, scene);
  draw_ways(drawing, scene);
  draw_landmarks(drawing, scene);
  cv::imwrite(picture, drawing.picture());
  std::printf("%s: %zu meshes, %zu landmarks\n", scene.name.c_str(), scene.meshes.size(),
              scene.landmarks.size());
}

}  // namespace
}  // namespace roomwise::simulator

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: draw_scenario FILE.toml OUT.png\n");
    return 2;
  }
  try {
    roomwise::simulator::draw(argv[1], argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "draw_scenario: %s\n", error.what());
    return 1;
  }
}
