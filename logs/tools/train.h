#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "services/segment_svc/core/color/color_model.h"
#include "services/segment_svc/core/color/training.h"

namespace roomwise {

/// What `rwlog train` is asked for. The frame is named by its number or by its time.
struct Training {
  std::filesystem::path log;
  std::optional<std::int64_t> frame;  ///< KINECT_FRAME.seq - 1
  std::optional<std::int64_t> utime;
  std::vector<std::string> rectangles;  ///< as rectangle_of reads them
  segment::GreyStatistics statistics = segment::GreyStatistics::kAverage;
  std::filesystem::path model;
};

/// Reads "label,left,top,width,height", in pixels of the colour image; label is obstacle, wall,
/// accessible, or its number. Throws std::runtime_error naming the text.
segment::TrainingRectangle rectangle_of(std::string_view text);

/// Learns a model for segment_svc from rectangles on a frame of a log, and writes it, whole or not
/// at all. Throws std::runtime_error with the reason, naming the log or the file.
segment::ColorModel train_model(const Training& training);

}  // namespace roomwise
