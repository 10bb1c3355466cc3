#pragma once
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

namespace roomwise {

/// Each part 0-255.
struct Color {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

inline constexpr Color kPaper{255, 255, 255};
inline constexpr Color kInk{32, 36, 40};

/// A picture to draw on with smooth edges: it is kept twice as large and made smaller at the end.
/// All places and sizes are in pixels of the finished picture; what lies outside is cut off.
class Canvas {
 public:
  Canvas(int width_px, int height_px, Color background);

  int width_px() const { return image_.cols / kScale; }
  int height_px() const { return image_.rows / kScale; }

  void rectangle(const cv::Rect2d& box, Color color, double opacity = 1.0);
  void line(cv::Point2d from, cv::Point2d to, Color color, double width_px);
  void polyline(const std::vector<cv::Point2d>& points, Color color, double width_px);
  void disc(cv::Point2d centre, double radius_px, Color color);
  void polygon(const std::vector<cv::Point2d>& points, Color color, double opacity);
  /// An upright cross.
  void cross(cv::Point2d centre, double radius_px, Color color, double width_px);
  /// Copies `image` over the place at `corner`, made `scale` times as large.
  void picture(const cv::Mat3b& image, cv::Point corner, int scale);

  /// Text whose baseline begins at `start`; `height_px` of a capital.
  void text(cv::Point2d start, const std::string& words, double height_px, Color color);
  /// The same with an outline, to be read on any ground.
  void outlined_text(cv::Point2d start, const std::string& words, double height_px, Color color,
                     Color outline);
  static double text_width_px(const std::string& words, double height_px);

  /// Until the next call, only what lies in `box` is drawn.
  void clip(const cv::Rect2d& box);
  void unclip();

  /// The finished picture, blue green red.
  cv::Mat3b finish() const;

 private:
  static constexpr int kScale = 2;
  cv::Point fixed_point(cv::Point2d place) const;
  std::vector<cv::Point> fixed_points(const std::vector<cv::Point2d>& points) const;
  static int line_width(double width_px);
  /// Draws on a copy and blends it in.
  template <class Draw>
  void blend(double opacity, Draw draw);

  cv::Mat3b image_;
  cv::Mat3b drawn_;   ///< the part of image_ inside the clip box
  cv::Point offset_;  ///< of that part
};

}  // namespace roomwise
