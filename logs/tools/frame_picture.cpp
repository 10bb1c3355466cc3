#include "logs/tools/frame_picture.h"

#include <fmt/core.h>

#include <algorithm>

namespace roomwise {
namespace {

constexpr int kWanted_px = 1280;  // width of the image in the picture
constexpr int kTop_px = 64;
constexpr int kMargin_px = 20;
constexpr int kColumn_px = 400;
constexpr double kCapital_px = 12.0;

int scale_for(int width_px) { return std::max(1, kWanted_px / width_px); }

}  // namespace

FramePicture::FramePicture(const RgbdFrame& frame, const cv::Mat3b& image, const std::string& title)
    : scale_(scale_for(image.cols)),
      image_px_(image.size() * scale_),
      canvas_(image_px_.width + kColumn_px + 3 * kMargin_px,
              std::max(image_px_.height, 480) + kTop_px + kMargin_px, kPaper),
      row_y_px_(kTop_px + 20) {
  canvas_.picture(image, {kMargin_px, kTop_px}, scale_);
  canvas_.text({kMargin_px, 42}, fmt::format("{}, frame {}", title, frame.seq - 1), 17, kInk);
}

cv::Point2d FramePicture::place(double u_px, double v_px) const {
  return {kMargin_px + (u_px + 0.5) * scale_, kTop_px + (v_px + 0.5) * scale_};
}

cv::Rect2d FramePicture::image_box() const {
  return {double(kMargin_px), double(kTop_px), double(image_px_.width), double(image_px_.height)};
}

void FramePicture::row(const std::string& words) {
  canvas_.text({image_px_.width + 2.0 * kMargin_px, row_y_px_}, words, kCapital_px, kInk);
  row_y_px_ += 30;
}

void FramePicture::row(Color color, const std::string& words) {
  const double x_px = image_px_.width + 2.0 * kMargin_px;
  canvas_.rectangle({x_px, row_y_px_ - 14, 26, 16}, color);
  canvas_.text({x_px + 40, row_y_px_}, words, kCapital_px, kInk);
  row_y_px_ += 30;
}

cv::Rect2d FramePicture::rest() const {
  const double x_px = image_px_.width + 2.0 * kMargin_px;
  return {x_px, row_y_px_, double(kColumn_px), canvas_.height_px() - kMargin_px - row_y_px_};
}

cv::Mat3b as_mat(const ColorImage& color) {
  cv::Mat3b image(color.height_px, color.width_px);
  for (int i = 0; i < static_cast<int>(image.total()); ++i) {
    const std::uint8_t* rgb = &color.rgb[3 * static_cast<std::size_t>(i)];
    image(i / color.width_px, i % color.width_px) = {rgb[2], rgb[1], rgb[0]};
  }
  return image;
}

}  // namespace roomwise
