#pragma once
#include "common/bus/bus.h"
#include "common/frames/frame_decoder.h"
#include "common/frames/label_encoder.h"
#include "services/segment_svc/color_memory.h"
#include "services/segment_svc/core/segmenter.h"

namespace roomwise {

/// KINECT_FRAME in, SEGMENTS out, one for each frame that can be decoded; SEGMENT_TRAIN teaches the
/// grey Gaussians on one of the frames seen lately. What was learned is used at once and, but in a
/// replay, written to the model file; training that fails is counted and changes nothing.
class SegmentService {
 public:
  using Params = segment::SegmentParams;

  /// Reads the model file if there is one; throws std::runtime_error naming it if it is refused.
  SegmentService(Bus& bus, const Params& params);

 private:
  void on_frame(const kinect_frame_t& message);
  void on_training(const segment_training_t& message);
  void learn(const segment::ColorModel& taught);
  void fill_message();

  Bus& bus_;
  Params params_;
  FrameDecoder decoder_;
  ColorMemory colors_;
  segment::Segmenter segmenter_;
  LabelEncoder label_encoder_;
  RgbdFrame frame_;
  segment::Segmentation segmentation_;
  segmentation_t message_{};
};

}  // namespace roomwise
