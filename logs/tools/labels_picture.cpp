#include "logs/tools/labels_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "logs/tools/frame_picture.h"
#include "logs/tools/label_image.h"

namespace roomwise {
namespace {

constexpr Color kNoteInk{150, 154, 158};
constexpr Color kFree{40, 180, 70};

struct Label {
  int value;
  const char* name;
  Color color;
};
constexpr std::array kLabels = {
    Label{segmentation_t::LABEL_ACCESSIBLE, "accessible", {40, 200, 70}},
    Label{segmentation_t::LABEL_OBSTACLE, "obstacle", {235, 60, 50}},
    Label{segmentation_t::LABEL_WALL, "wall", {60, 120, 255}},
    Label{segmentation_t::LABEL_DROP_OFF, "drop-off", {220, 60, 240}},
    Label{segmentation_t::LABEL_UNKNOWN, "unknown", {128, 128, 128}},
};

cv::Mat3b tinted(const cv::Mat3b& image, const cv::Mat1b& labels) {
  constexpr double kOpacity = 0.45;
  cv::Mat1b fitted;
  cv::resize(labels, fitted, image.size(), 0, 0, cv::INTER_NEAREST);
  cv::Mat3b tint = image.clone();
  for (const Label& label : kLabels) {
    const Color c = label.color;
    tint.setTo(cv::Scalar(c.blue, c.green, c.red), fitted == label.value);
  }
  cv::Mat3b blended;
  cv::addWeighted(tint, kOpacity, image, 1.0 - kOpacity, 0.0, blended);
  return blended;
}

double degrees(double angle_rad) { return angle_rad * 180.0 / std::numbers::pi; }

void draw_legend(FramePicture& picture, const cv::Mat1b& labels) {
  for (const Label& label : kLabels) {
    const int count = cv::countNonZero(labels == label.value);
    const double share = 100.0 * count / static_cast<double>(labels.total());
    picture.row(label.color, fmt::format("{} {:.1f} %", label.name, share));
  }
}

void draw_floor_text(FramePicture& picture, const segmentation_t& segments) {
  picture.gap();
  picture.row(fmt::format("model {}", segments.model));
  picture.row(fmt::format("camera {:.3f} m above the floor", segments.floor_height_m));
  picture.row(fmt::format("pitch {:.1f} deg down, roll {:.1f} deg",
                          degrees(segments.camera_pitch_rad), degrees(segments.camera_roll_rad)));
  picture.row(segments.floor_trusted != 0
                  ? fmt::format("floor found, {} inliers", segments.floor_inliers)
                  : std::string("floor kept from before"));
}

/// The bins seen from above: robot at the bottom, its x upwards.
class Fan {
 public:
  Fan(const cv::Rect2d& box, const segmentation_t& segments) : segments_(segments) {
    constexpr double kLeast_m = 1.0;
    constexpr double kMost_m = 10.0;
    reach_m_ = kLeast_m;
    for (const double range_m : segments.free_range_m) {
      if (range_m > reach_m_) reach_m_ = std::min(range_m, kMost_m);
    }
    origin_ = {box.x + box.width / 2, box.br().y - 16};
    scale_px_per_m_ = std::min(box.height - 50, box.width / 2 - 10) / reach_m_;
  }

  void draw(Canvas& canvas) const {
    for (std::size_t i = 0; i < segments_.free_range_m.size(); ++i) draw_bin(canvas, i);
    for (int ring_m = 1; ring_m <= static_cast<int>(reach_m_); ++ring_m) draw_ring(canvas, ring_m);
    canvas.disc(origin_, 5.0, kInk);
  }

 private:
  cv::Point2d place(double range_m, double bearing_rad) const {
    return {origin_.x - scale_px_per_m_ * range_m * std::sin(bearing_rad),
            origin_.y - scale_px_per_m_ * range_m * std::cos(bearing_rad)};
  }

  void draw_bin(Canvas& canvas, std::size_t i) const {
    const double range_m = std::min(segments_.free_range_m[i], reach_m_);
    if (!(range_m > 0.0)) return;
    const double middle_rad =
        segments_.bin_first_bearing_rad + static_cast<double>(i) * segments_.bin_step_rad;
    const double half_rad = 0.5 * segments_.bin_step_rad;
    canvas.polygon(
        {origin_, place(range_m, middle_rad - half_rad), place(range_m, middle_rad + half_rad)},
        kFree, 0.5);
  }

  void draw_ring(Canvas& canvas, int ring_m) const {
    constexpr int kSteps = 40;
    std::vector<cv::Point2d> arc;
    for (int i = 0; i <= kSteps; ++i) {
      arc.push_back(place(ring_m, std::numbers::pi * (double(i) / kSteps - 0.5)));
    }
    canvas.polyline(arc, kNoteInk, 1.0);
    canvas.text(place(ring_m, 0.0) + cv::Point2d(4, -4), fmt::format("{} m", ring_m), 9, kInk);
  }

  const segmentation_t& segments_;
  double reach_m_ = 0.0;
  cv::Point2d origin_;
  double scale_px_per_m_ = 0.0;
};

}  // namespace

cv::Mat3b draw_labels(const RgbdFrame& frame, const segmentation_t& segments) {
  const auto labels = decode_labels(segments);
  if (!labels) throw std::runtime_error("label image cannot be decoded");
  FramePicture picture(frame, tinted(as_mat(frame.color), *labels), "Labels");
  draw_legend(picture, *labels);
  draw_floor_text(picture, segments);
  if (segments.bin_count > 0) {
    picture.gap();
    picture.row("free range by bearing");
    Fan(picture.rest(), segments).draw(picture.canvas());
  }
  return picture.finish();
}

}  // namespace roomwise
