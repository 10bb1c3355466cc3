#include "tests/segment_svc/models/lessons.h"

#include <stdexcept>
#include <string>

namespace roomwise::segment {

void Lessons::add(const ColorImage& picture, const std::vector<TrainingRectangle>& rectangles) {
  for (TrainingRectangle rectangle : rectangles) {
    if (rectangle.width_px == 0) continue;
    rectangle.top_px += pictures_.height_px;
    rectangles_.push_back(rectangle);
  }
  pictures_.width_px = picture.width_px;
  pictures_.height_px += picture.height_px;
  pictures_.rgb.insert(pictures_.rgb.end(), picture.rgb.begin(), picture.rgb.end());
}

ColorModel Lessons::learn(GreyStatistics how) const {
  auto learned = train(pictures_, rectangles_, how);
  if (const auto* fault = std::get_if<TrainingFault>(&learned)) {
    throw std::runtime_error(std::string("lessons: ") + name_of(*fault));
  }
  return std::get<ColorModel>(std::move(learned));
}

GreyHistogram Lessons::histogram(int label) const {
  GreyHistogram histogram{};
  for (const TrainingRectangle& r : rectangles_) {
    if (r.label != label) continue;
    for (int v = r.top_px; v < r.top_px + r.height_px; ++v) {
      for (int u = r.left_px; u < r.left_px + r.width_px; ++u) {
        const std::uint8_t* rgb =
            pictures_.rgb.data() + 3 * static_cast<std::size_t>(v * pictures_.width_px + u);
        ++histogram[grey_level(rgb[0], rgb[1], rgb[2])];
      }
    }
  }
  return histogram;
}

}  // namespace roomwise::segment
