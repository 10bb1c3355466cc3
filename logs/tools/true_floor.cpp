#include "logs/tools/true_floor.h"

#include "common/bus/bus.h"
#include "logs/tools/label_image.h"

namespace roomwise {
namespace {

/// 255 floor, 0 not floor, 1 where nobody can know.
cv::Mat1b mask_of(const cv::Mat1b& labels) {
  cv::Mat1b mask(labels.size(), 0);
  mask.setTo(255, labels == segmentation_t::LABEL_ACCESSIBLE);
  mask.setTo(1, labels == segmentation_t::LABEL_UNKNOWN);
  return mask;
}

}  // namespace

void TrueFloor::gather(Bus& bus) {
  bus.subscribe(channels::kTrueSegments,
                [this, &bus](const segmentation_t& message) { meet(bus, message, truth_, said_); });
  bus.subscribe(channels::kSegments,
                [this, &bus](const segmentation_t& message) { meet(bus, message, said_, truth_); });
}

void TrueFloor::meet(Bus& bus, const segmentation_t& message, ByFrame& own, ByFrame& others) {
  const auto other = others.find(message.frame_seq);
  if (other == others.end()) {
    own.insert_or_assign(message.frame_seq, message);
    return;
  }
  const bool is_truth = &own == &truth_;
  compare(bus, is_truth ? message : other->second, is_truth ? other->second : message);
  others.erase(other);
}

void TrueFloor::compare(Bus& bus, const segmentation_t& truth, const segmentation_t& said) {
  const auto true_labels = decode_labels(truth);
  const auto labels = decode_labels(said);
  if (true_labels && labels) {
    frames_.push_back(count_floor(*labels, mask_of(*true_labels)));
  } else {
    bus.count("labels_not_decodable");
  }
}

}  // namespace roomwise
