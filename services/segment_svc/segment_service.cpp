#include "services/segment_svc/segment_service.h"

#include <filesystem>
#include <stdexcept>
#include <variant>

#include "services/segment_svc/core/color/training.h"
#include "services/segment_svc/model_file.h"

namespace roomwise {
namespace {

constexpr std::size_t kColorMemory_bytes = 24U << 20U;  // some ten seconds of JPEG, or one of raw

std::vector<segment::TrainingRectangle> to_rectangles(const segment_training_t& message) {
  std::vector<segment::TrainingRectangle> rectangles;
  for (const training_rectangle_t& r : message.rectangles) {
    rectangles.push_back({.label = r.label,
                          .left_px = r.left_px,
                          .top_px = r.top_px,
                          .width_px = r.width_px,
                          .height_px = r.height_px});
  }
  return rectangles;
}

void fill_floor(const segment::FloorEstimate& floor, segmentation_t& message) {
  for (int i = 0; i < 3; ++i) message.floor_normal_ratio[i] = floor.plane.normal[i];
  message.floor_height_m = floor.plane.height_m;
  message.camera_pitch_rad = floor.plane.pitch_rad();
  message.camera_roll_rad = floor.plane.roll_rad();
  message.floor_inliers = floor.inliers;
  message.floor_trusted = floor.trusted ? 1 : 0;
}

void fill_distances(const segment::ViewDistances& distances, segmentation_t& message) {
  const auto& fraction = distances.class_fraction;
  const auto& mean_m = distances.class_mean_m;
  message.class_count = static_cast<std::int32_t>(segment::kLabels.size());
  message.class_label.assign(segment::kLabels.begin(), segment::kLabels.end());
  message.class_fraction_ratio.assign(fraction.begin(), fraction.end());
  message.class_mean_distance_m.assign(mean_m.begin(), mean_m.end());
  message.mean_distance_m = distances.mean_m;
}

void fill_bearings(const std::array<segment::BearingBin, segment::FreeRange::kBins>& bearings,
                   segmentation_t& message) {
  message.bin_count = static_cast<std::int32_t>(bearings.size());
  message.bin_first_bearing_rad = segment::FreeRange::first_bearing_rad();
  message.bin_step_rad = segment::FreeRange::step_rad();
  message.free_range_m.clear();
  message.unknown_ratio.clear();
  message.obstacle_range_m.clear();
  for (const segment::BearingBin& bin : bearings) {
    message.free_range_m.push_back(bin.free_range_m);
    message.unknown_ratio.push_back(bin.unknown_ratio);
    message.obstacle_range_m.push_back(bin.obstacle_range_m);
  }
}

}  // namespace

SegmentService::SegmentService(Bus& bus, const Params& params)
    : bus_(bus),
      params_(params),
      decoder_(params.model == "geometry" ? ColorUse::kSkip : ColorUse::kDecode),
      colors_(kColorMemory_bytes),
      segmenter_(params) {
  if (!params_.model_path.empty() && std::filesystem::exists(params_.model_path)) {
    segmenter_.learn(segment::load_model(params_.model_path));
  }
  bus_.subscribe(
      channels::kKinectFrame, [this](const kinect_frame_t& m) { on_frame(m); }, Delivery::kLatest);
  bus_.subscribe(channels::kSegmentTrain, [this](const segment_training_t& m) { on_training(m); });
}

void SegmentService::on_frame(const kinect_frame_t& message) {
  colors_.keep(message);
  const FrameResult result = decoder_.decode(message, frame_);
  if (result != FrameResult::kOk) return bus_.count(counter_name(result));
  segmenter_.segment(frame_, segmentation_);
  if (!segmentation_.floor.trusted) bus_.count("floor_untrusted");
  if (params_.model != segmenter_.model_in_force()) bus_.count("model_not_in_force");
  fill_message();
  bus_.publish(channels::kSegments, message_);
}

void SegmentService::on_training(const segment_training_t& message) {
  ColorImage color;
  if (!colors_.recall(message.train_frame_utime, color)) {
    return bus_.count("training_frame_not_kept");
  }
  const auto learned = segment::train(color, to_rectangles(message),
                                      params_.training_statistics == "threshold"
                                          ? segment::GreyStatistics::kThreshold
                                          : segment::GreyStatistics::kAverage);
  if (const auto* fault = std::get_if<segment::TrainingFault>(&learned)) {
    return bus_.count(name_of(*fault));
  }
  learn(std::get<segment::ColorModel>(learned));
}

void SegmentService::learn(const segment::ColorModel& taught) {
  segmenter_.learn(taught);
  bus_.count("training_learned");
  if (params_.model_path.empty() || bus_.is_replay()) return;
  try {
    segment::save_model(params_.model_path, taught);
  } catch (const std::runtime_error& error) {  // a full disk is no reason to stop looking
    bus_.count("model_not_saved");
    bus_.note_error(error.what());
  }
}

void SegmentService::fill_message() {
  message_.utime = frame_.utime;
  message_.frame_seq = frame_.seq;
  message_.model = segmenter_.model_in_force();
  message_.safe_distance_m = params_.safe_distance_m;
  label_encoder_.encode(segmentation_.labels, frame_.depth.width_px, frame_.depth.height_px,
                        message_);
  fill_floor(segmentation_.floor, message_);
  fill_distances(segmentation_.distances, message_);
  message_.near_distance_m = segmentation_.corridor.near_m;
  message_.corridor_unknown_ratio = segmentation_.corridor.unknown_ratio;
  fill_bearings(segmentation_.bearings, message_);
}

}  // namespace roomwise
