#pragma once
#include <string>

#include "common/image/rgbd_frame.h"
#include "logs/tools/canvas.h"

namespace roomwise {

/// A frame's colour image, enlarged, with a title above and a column of words beside it.
class FramePicture {
 public:
  FramePicture(const RgbdFrame& frame, const cv::Mat3b& image, const std::string& title);

  /// Pixels of the picture a pixel of the image.
  int scale() const { return scale_; }
  /// Where a pixel of the image (its centre) lies in the picture.
  cv::Point2d place(double u_px, double v_px) const;
  cv::Rect2d image_box() const;
  Canvas& canvas() { return canvas_; }

  /// A row of the column: words, after a patch of colour if one is given.
  void row(const std::string& words);
  void row(Color color, const std::string& words);
  void gap() { row_y_px_ += 16; }
  /// What is left of the column.
  cv::Rect2d rest() const;

  cv::Mat3b finish() const { return canvas_.finish(); }

 private:
  int scale_;
  cv::Size image_px_;
  Canvas canvas_;
  double row_y_px_;
};

/// Red green blue to OpenCV's order.
cv::Mat3b as_mat(const ColorImage& color);

}  // namespace roomwise
