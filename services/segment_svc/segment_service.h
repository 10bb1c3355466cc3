#pragma once
#include "common/bus/bus.h"
#include "common/frames/frame_decoder.h"
#include "services/segment_svc/core/segmenter.h"
#include "services/segment_svc/label_codec.h"

namespace roomwise {

/// KINECT_FRAME in, SEGMENTS out, one for each frame that can be decoded; SEGMENT_TRAIN teaches the
/// grey Gaussians on the frame the service saw last.
class SegmentService {
 public:
  using Params = segment::SegmentParams;

  /// Throws std::runtime_error naming the model file if it is refused.
  SegmentService(Bus& bus, const Params& params);

 private:
  void on_frame(const kinect_frame_t& message);
  void on_training(const segment_training_t& message);
  void fill_message();

  Bus& bus_;
  Params params_;
  FrameDecoder decoder_{ColorUse::kDecode};
  segment::Segmenter segmenter_;
  LabelEncoder label_encoder_;
  bool has_frame_ = false;
  RgbdFrame frame_;
  segment::Segmentation segmentation_;
  segmentation_t message_{};
};

}  // namespace roomwise
