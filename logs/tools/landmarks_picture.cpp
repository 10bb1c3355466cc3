#include "logs/tools/landmarks_picture.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

#include "logs/tools/frame_picture.h"

namespace roomwise {
namespace {

constexpr Color kEdge{0, 235, 255};
constexpr Color kBlack{0, 0, 0};
constexpr Color kWhite{255, 255, 255};

struct Kind {
  const char* name;
  Color color;
};
// In the order of landmark_observation_t::KIND_*.
constexpr std::array kKinds = {
    Kind{"unknown", {190, 190, 190}},       Kind{"left edge", {255, 80, 60}},
    Kind{"right edge", {255, 190, 0}},      Kind{"convex crease", {80, 220, 80}},
    Kind{"concave crease", {90, 140, 255}}, Kind{"pole", {230, 80, 255}},
    Kind{"fiducial", {255, 255, 255}},
};

const Kind& kind_of(const landmark_observation_t& landmark) {
  const auto index =
      static_cast<std::uint8_t>(landmark.kind);  // what is negative becomes too large
  return kKinds[index < kKinds.size() ? index : 0];
}

/// From pixels of the depth image to pixels of the colour image.
struct ToColor {
  double u_ratio;
  double v_ratio;
  double u(double u_px) const { return (u_px + 0.5) * u_ratio - 0.5; }
  double v(double v_px) const { return (v_px + 0.5) * v_ratio - 0.5; }
};

ToColor to_color(const RgbdFrame& frame, const landmark_list_t& landmarks) {
  const auto ratio = [](int color_px, int depth_px) {
    return depth_px > 0 ? double(color_px) / depth_px : 1.0;
  };
  return {ratio(frame.color.width_px, landmarks.width_px),
          ratio(frame.color.height_px, landmarks.height_px)};
}

void draw_edges(FramePicture& picture, const ToColor& to_color, const landmark_list_t& landmarks) {
  const double side_px = std::max(1.0, 0.8 * picture.scale());
  for (std::size_t i = 0; i < landmarks.edge_u_px.size(); ++i) {
    const cv::Point2d centre =
        picture.place(to_color.u(landmarks.edge_u_px[i]), to_color.v(landmarks.edge_v_px[i]));
    picture.canvas().rectangle({centre.x - side_px / 2, centre.y - side_px / 2, side_px, side_px},
                               kEdge);
  }
}

/// Ranges beside the strokes, moved down where another already stands.
class RangeTexts {
 public:
  void draw(Canvas& canvas, cv::Point2d stroke_top, const landmark_observation_t& landmark) {
    constexpr double kTextHeight_px = 12.0;
    const std::string words = fmt::format("{:.2f} m", landmark.range_m);
    cv::Rect2d box(stroke_top.x + 6, stroke_top.y, Canvas::text_width_px(words, kTextHeight_px),
                   17);
    const auto overlaps = [&box](const cv::Rect2d& other) { return (box & other).area() > 0.0; };
    while (std::ranges::any_of(boxes_, overlaps)) box.y += 18;
    boxes_.push_back(box);
    canvas.outlined_text({box.x, box.br().y - 2}, words, kTextHeight_px, kWhite, kBlack);
  }

 private:
  std::vector<cv::Rect2d> boxes_;
};

/// Ends of a landmark's stroke.
struct Stroke {
  cv::Point2d top;
  cv::Point2d bottom;
};

Stroke stroke_of(const FramePicture& picture, const ToColor& to_color,
                 const landmark_observation_t& landmark) {
  const double u_px = to_color.u(landmark.pixel_u_px);
  return {picture.place(u_px, to_color.v(landmark.pixel_v_top_px)),
          picture.place(u_px, to_color.v(landmark.pixel_v_bottom_px))};
}

void draw_strokes(FramePicture& picture, const ToColor& to_color,
                  const landmark_list_t& landmarks) {
  RangeTexts texts;
  Canvas& canvas = picture.canvas();
  for (const landmark_observation_t& landmark : landmarks.landmarks) {
    const Stroke stroke = stroke_of(picture, to_color, landmark);
    if (!picture.image_box().contains(stroke.top)) continue;
    canvas.line(stroke.top, stroke.bottom, kBlack, 6.0);
    canvas.line(stroke.top, stroke.bottom, kind_of(landmark).color, 3.5);
    canvas.disc(stroke.top, 4.0, kind_of(landmark).color);
    canvas.disc(stroke.bottom, 4.0, kind_of(landmark).color);
  }
  for (const landmark_observation_t& landmark : landmarks.landmarks) {
    const Stroke stroke = stroke_of(picture, to_color, landmark);
    if (picture.image_box().contains(stroke.top)) texts.draw(canvas, stroke.top, landmark);
  }
}

void draw_column(FramePicture& picture, const landmark_list_t& landmarks) {
  std::map<const Kind*, int> counts;
  for (const landmark_observation_t& landmark : landmarks.landmarks) ++counts[&kind_of(landmark)];
  picture.row(fmt::format("{} landmarks", landmarks.count));
  for (const auto& [kind, count] : counts) {
    picture.row(kind->color, fmt::format("{}: {}", kind->name, count));
  }
  picture.gap();
  picture.row(kEdge, fmt::format("{} edge pixels", landmarks.edge_count));
  picture.row(fmt::format("colour weight {:.2f}, depth {:.2f}", landmarks.alpha_ratio,
                          landmarks.beta_ratio));
  if (!landmarks.rejections.empty()) picture.gap();
  for (const named_count_t& rejection : landmarks.rejections) {
    if (rejection.count > 0) picture.row(fmt::format("{} {}", rejection.count, rejection.name));
  }
}

}  // namespace

cv::Mat3b draw_landmarks(const RgbdFrame& frame, const landmark_list_t& landmarks) {
  FramePicture picture(frame, as_mat(frame.color), "Landmarks");
  const ToColor mapping = to_color(frame, landmarks);
  picture.canvas().clip(picture.image_box());
  draw_edges(picture, mapping, landmarks);
  draw_strokes(picture, mapping, landmarks);
  picture.canvas().unclip();
  draw_column(picture, landmarks);
  return picture.finish();
}

}  // namespace roomwise
