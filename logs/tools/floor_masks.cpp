#include "logs/tools/floor_masks.h"

#include <fmt/core.h>

#include <stdexcept>

#include "common/bus/bus.h"
#include "logs/tools/frame_files.h"
#include "logs/tools/image_file.h"
#include "logs/tools/label_image.h"

namespace roomwise {

FloorMasks::FloorMasks(const std::filesystem::path& folder) {
  for (const auto& [number, path] : find_frame_files(folder, ".floor.png")) {
    mask_of_frame_seq_.emplace(std::int64_t{number} + 1, path);
  }
}

void FloorMasks::gather(Bus& bus) {
  bus.subscribe(channels::kSegments,
                [this, &bus](const segmentation_t& message) { compare(bus, message); });
}

void FloorMasks::compare(Bus& bus, const segmentation_t& message) {
  const auto mask = mask_of_frame_seq_.find(message.frame_seq);
  if (mask == mask_of_frame_seq_.end()) return;
  if (const auto labels = decode_labels(message)) {
    frames_.push_back(count_floor(*labels, read_grey_png(mask->second)));
  } else {
    bus.count("labels_not_decodable");
  }
}

}  // namespace roomwise
