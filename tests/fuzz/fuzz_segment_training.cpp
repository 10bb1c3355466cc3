// SEGMENT_TRAIN with any rectangles on a small image: refused by name, or a model that its
// file takes.
#include <cstdint>
#include <cstring>
#include <variant>
#include <vector>

#include "services/segment_svc/core/color/model_text.h"
#include "services/segment_svc/core/color/training.h"

namespace {

using namespace roomwise::segment;

constexpr int kWidth_px = 16;
constexpr int kHeight_px = 12;
constexpr std::size_t kRectangle_bytes = 17;

roomwise::ColorImage image_of(std::uint8_t seed) {
  roomwise::ColorImage image{.width_px = kWidth_px, .height_px = kHeight_px, .rgb = {}};
  for (std::uint32_t i = 0; i < 3U * kWidth_px * kHeight_px; ++i) {
    image.rgb.push_back(static_cast<std::uint8_t>(i * seed >> 2U));
  }
  return image;
}

/// A small number as it is, so that rectangles often lie inside; one in eight is any number.
std::int32_t number_at(const std::uint8_t* data) {
  std::int32_t any = 0;
  std::memcpy(&any, data, sizeof any);
  return data[0] < 224 ? data[0] % 20 : any;
}

TrainingRectangle rectangle_at(const std::uint8_t* data) {
  const int label = data[0] < 250 ? 100 * (data[0] % 3) : data[0];
  return {.label = label,
          .left_px = number_at(data + 1),
          .top_px = number_at(data + 5),
          .width_px = number_at(data + 9),
          .height_px = number_at(data + 13)};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const roomwise::ColorImage image = image_of(data[0]);
  std::vector<TrainingRectangle> rectangles;
  for (std::size_t at = 1; at + kRectangle_bytes <= size; at += kRectangle_bytes) {
    rectangles.push_back(rectangle_at(data + at));
  }
  for (const GreyStatistics how : {GreyStatistics::kAverage, GreyStatistics::kThreshold}) {
    const auto learned = train(image, rectangles, how);
    if (const auto* fault = std::get_if<TrainingFault>(&learned)) {
      if (*name_of(*fault) == '\0') __builtin_trap();
      continue;
    }
    const auto text = format_model(std::get<ColorModel>(learned));
    if (!std::holds_alternative<ColorModel>(parse_model(text))) __builtin_trap();
  }
  return 0;
}
