#include "logs/tools/canvas.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace roomwise {
namespace {

constexpr int kFractionBits = 4;
constexpr double kFarthest_px = 1e6;  // keeps fixed-point places inside int
constexpr int kFont = cv::FONT_HERSHEY_SIMPLEX;
constexpr double kFontCapital_px = 21.0;  // of a capital at scale 1

cv::Scalar scalar(Color color) {
  return {double(color.blue), double(color.green), double(color.red)};
}

}  // namespace

Canvas::Canvas(int width_px, int height_px, Color background)
    : image_(height_px * kScale, width_px * kScale), drawn_(image_) {
  image_.setTo(scalar(background));
}

cv::Point Canvas::fixed_point(cv::Point2d place) const {
  const auto fixed = [](double place_px, int offset_px) {
    if (std::isnan(place_px)) place_px = -kFarthest_px;
    const double in_reach = std::clamp(place_px * kScale - offset_px, -kFarthest_px, kFarthest_px);
    return static_cast<int>(std::lround(in_reach * (1 << kFractionBits)));
  };
  return {fixed(place.x, offset_.x), fixed(place.y, offset_.y)};
}

std::vector<cv::Point> Canvas::fixed_points(const std::vector<cv::Point2d>& points) const {
  std::vector<cv::Point> fixed;
  fixed.reserve(points.size());
  for (const cv::Point2d& point : points) fixed.push_back(fixed_point(point));
  return fixed;
}

int Canvas::line_width(double width_px) {
  return std::max(1, static_cast<int>(std::lround(width_px * kScale)));
}

void Canvas::rectangle(const cv::Rect2d& box, Color color, double opacity) {
  polygon({box.tl(), {box.br().x, box.y}, box.br(), {box.x, box.br().y}}, color, opacity);
}

void Canvas::line(cv::Point2d from, cv::Point2d to, Color color, double width_px) {
  cv::line(drawn_, fixed_point(from), fixed_point(to), scalar(color), line_width(width_px),
           cv::LINE_AA, kFractionBits);
}

void Canvas::polyline(const std::vector<cv::Point2d>& points, Color color, double width_px) {
  const std::vector<cv::Point> fixed = fixed_points(points);
  cv::polylines(drawn_, fixed, false, scalar(color), line_width(width_px), cv::LINE_AA,
                kFractionBits);
}

void Canvas::disc(cv::Point2d centre, double radius_px, Color color) {
  const int radius = static_cast<int>(std::lround(radius_px * kScale * (1 << kFractionBits)));
  cv::circle(drawn_, fixed_point(centre), radius, scalar(color), cv::FILLED, cv::LINE_AA,
             kFractionBits);
}

void Canvas::polygon(const std::vector<cv::Point2d>& points, Color color, double opacity) {
  if (points.empty()) return;
  const std::vector<cv::Point> fixed = fixed_points(points);
  blend(opacity, [&](cv::Mat3b& image) {
    cv::fillPoly(image, std::vector{fixed}, scalar(color), cv::LINE_AA, kFractionBits);
  });
}

template <class Draw>
void Canvas::blend(double opacity, Draw draw) {
  if (opacity >= 1.0) {
    draw(drawn_);
    return;
  }
  cv::Mat3b over = drawn_.clone();
  draw(over);
  cv::addWeighted(over, opacity, drawn_, 1.0 - opacity, 0.0, drawn_);
}

void Canvas::cross(cv::Point2d centre, double radius_px, Color color, double width_px) {
  line({centre.x - radius_px, centre.y}, {centre.x + radius_px, centre.y}, color, width_px);
  line({centre.x, centre.y - radius_px}, {centre.x, centre.y + radius_px}, color, width_px);
}

void Canvas::picture(const cv::Mat3b& image, cv::Point corner, int scale) {
  cv::Mat3b larger;
  const int factor = scale * kScale;
  cv::resize(image, larger, {}, factor, factor, cv::INTER_CUBIC);
  const cv::Rect wanted(corner * kScale, larger.size());
  const cv::Rect seen = wanted & cv::Rect({}, image_.size());
  larger(seen - wanted.tl()).copyTo(image_(seen));
}

void Canvas::text(cv::Point2d start, const std::string& words, double height_px, Color color) {
  const double scale = height_px * kScale / kFontCapital_px;
  const int width = std::max(1, static_cast<int>(std::lround(height_px * kScale / 11.0)));
  const cv::Point place(static_cast<int>(std::lround(start.x * kScale)) - offset_.x,
                        static_cast<int>(std::lround(start.y * kScale)) - offset_.y);
  cv::putText(drawn_, words, place, kFont, scale, scalar(color), width, cv::LINE_AA);
}

void Canvas::outlined_text(cv::Point2d start, const std::string& words, double height_px,
                           Color color, Color outline) {
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) text(start + cv::Point2d(x, y), words, height_px, outline);
  }
  text(start, words, height_px, color);
}

double Canvas::text_width_px(const std::string& words, double height_px) {
  int baseline = 0;
  const double scale = height_px * kScale / kFontCapital_px;
  return cv::getTextSize(words, kFont, scale, 1, &baseline).width / double(kScale);
}

void Canvas::clip(const cv::Rect2d& box) {
  const cv::Rect wanted(cv::Point(box.tl() * kScale), cv::Point(box.br() * kScale));
  const cv::Rect seen = wanted & cv::Rect({}, image_.size());
  drawn_ = image_(seen);
  offset_ = seen.tl();
}

void Canvas::unclip() {
  drawn_ = image_;
  offset_ = {};
}

cv::Mat3b Canvas::finish() const {
  cv::Mat3b finished;
  cv::resize(image_, finished, {}, 1.0 / kScale, 1.0 / kScale, cv::INTER_AREA);
  return finished;
}

}  // namespace roomwise
