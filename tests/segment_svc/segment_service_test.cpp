#include "services/segment_svc/segment_service.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "common/bus/log_bus.h"
#include "common/frames/frame_encoder.h"
#include "services/segment_svc/model_file.h"
#include "tests/segment_svc/support/scenes.h"
#include "tests/segment_svc/support/taught.h"
#include "tests/support/events.h"
#include "tests/support/scratch_folder.h"

namespace roomwise {
namespace {

constexpr std::int64_t kStart_utime = 1'700'000'000'000'000;

kinect_frame_t message_of(const RgbdFrame& frame, std::int64_t number) {
  kinect_frame_t message{};
  message.utime = kStart_utime + number * 33'333;
  message.seq = number + 1;
  message.depth_registered = 1;
  FrameEncoder encoder;
  encoder.encode_depth(frame.depth, kinect_frame_t::DEPTH_PDZ16, message);
  encode_depth_camera(frame.depth_camera, message);
  encoder.encode_color(frame.color, kinect_frame_t::COLOR_RGB8, 90, message);
  message.color_fx_px = frame.color_camera.fx_px;
  message.color_fy_px = frame.color_camera.fy_px;
  message.color_cx_px = frame.color_camera.cx_px;
  message.color_cy_px = frame.color_camera.cy_px;
  encode_pose(frame.T_robot_camera, message);
  return message;
}

kinect_frame_t frame_number(std::int64_t number) {
  return message_of(segment::furnished_frame(
                        {.width_px = 320, .height_px = 240, .height_m = 0.5, .pitch_rad = 0.3},
                        static_cast<std::uint32_t>(number)),
                    number);
}

LogEvent event(const kinect_frame_t& message) {
  return event_of(channels::kKinectFrame, message.utime, message);
}

/// Rectangles on the frame's floor, far wall and box, which have colours of their own.
segment_training_t training_on(std::int64_t frame_number) {
  segment_training_t message{};
  message.utime = kStart_utime + frame_number * 33'333 + 1000;
  message.seq = 1;
  message.train_frame_utime = kStart_utime + frame_number * 33'333;
  message.rectangles = {{segmentation_t::LABEL_ACCESSIBLE, 20, 200, 200, 30},
                        {segmentation_t::LABEL_WALL, 60, 2, 60, 30},
                        {segmentation_t::LABEL_OBSTACLE, 185, 70, 20, 20}};
  message.rectangle_count = 3;
  return message;
}

LogEvent event(const segment_training_t& message) {
  return event_of(channels::kSegmentTrain, message.utime, message);
}

struct Outcome {
  std::vector<segmentation_t> segments;
  std::vector<LogEvent> events;
  std::map<std::string, std::int64_t, std::less<>> counts;
};

Outcome run(const std::vector<LogEvent>& input, const segment::SegmentParams& params = {}) {
  Outcome result;
  LogBus bus(input, result.events);
  SegmentService service(bus, params);
  bus.run();
  for (const LogEvent& published : result.events) {
    EXPECT_EQ(published.channel, "SEGMENTS");
    EXPECT_EQ(decode(published.data, result.segments.emplace_back()), DecodeResult::kOk);
  }
  for (const auto& [name, value] : bus.statistics().counters) result.counts[name] = value;
  return result;
}

segment::SegmentParams gaussian(const std::filesystem::path& model_path = {}) {
  segment::SegmentParams params;
  params.model = "gaussian";
  params.model_path = model_path.string();
  return params;
}

TEST(SegmentService, PublishesOneAnswerAFrame) {
  const Outcome result = run({event(frame_number(0)), event(frame_number(1))});
  ASSERT_EQ(result.segments.size(), 2U);
  const segmentation_t& s = result.segments[1];
  EXPECT_EQ(s.utime, kStart_utime + 33'333);
  EXPECT_EQ(s.seq, 2);
  EXPECT_EQ(s.frame_seq, 2);
  EXPECT_EQ(s.label_width_px, 320);
  EXPECT_EQ(s.label_height_px, 240);
  EXPECT_EQ(s.model, "fused");
  EXPECT_EQ(s.floor_trusted, 1);
  EXPECT_NEAR(s.floor_height_m, 0.5, 0.01);
  EXPECT_NEAR(s.camera_pitch_rad, 0.3, 0.01);
  EXPECT_EQ(s.class_label, (std::vector<std::int16_t>{0, 50, 100, 200, 255}));
  double whole = 0.0;
  for (const double fraction : s.class_fraction_ratio) whole += fraction;
  EXPECT_NEAR(whole, 1.0, 1e-9);
  EXPECT_EQ(s.bin_count, 91);
  EXPECT_EQ(s.safe_distance_m, 0.20);
  EXPECT_LT(s.label_size, 320 * 240 / 4);
}

TEST(SegmentService, SameLogGivesTheSameBytes) {
  const std::vector<LogEvent> input = {event(frame_number(0)), event(training_on(0)),
                                       event(frame_number(1)), event(frame_number(2))};
  const Outcome one = run(input, gaussian());
  const Outcome two = run(input, gaussian());
  ASSERT_EQ(one.events.size(), two.events.size());
  for (std::size_t i = 0; i < one.events.size(); ++i)
    EXPECT_EQ(one.events[i].data, two.events[i].data);
}

TEST(SegmentService, BadFramesAreCountedAndTheNextIsAnswered) {
  kinect_frame_t no_depth = frame_number(0);
  no_depth.depth_data.resize(7);
  no_depth.depth_size = 7;
  kinect_frame_t no_size = frame_number(1);
  no_size.depth_width_px = 0;
  kinect_frame_t not_finite = frame_number(2);
  not_finite.depth_fx_px = std::numeric_limits<double>::quiet_NaN();
  kinect_frame_t no_pose = frame_number(3);
  no_pose.T_robot_camera_quat[0] = std::numeric_limits<double>::infinity();
  const Outcome result = run(
      {event(no_depth), event(no_size), event(not_finite), event(no_pose), event(frame_number(4))});
  EXPECT_EQ(result.segments.size(), 1U);
  for (const char* name :
       {"frame_bad_depth", "frame_bad_size", "frame_bad_intrinsics", "frame_bad_pose"}) {
    EXPECT_EQ(result.counts.count(name), 1U) << name;
  }
}

TEST(SegmentService, EmptyFrameIsAnsweredWithNothingFree) {
  RgbdFrame frame = segment::furnished_frame({.width_px = 64, .height_px = 48});
  std::fill(frame.depth.steps.begin(), frame.depth.steps.end(), std::uint16_t{0});
  frame.color = {};
  const Outcome result = run({event(message_of(frame, 0))});
  ASSERT_EQ(result.segments.size(), 1U);
  EXPECT_EQ(result.segments[0].floor_trusted, 0);
  EXPECT_EQ(result.segments[0].class_fraction_ratio.back(), 1.0);
  for (const double range_m : result.segments[0].free_range_m) EXPECT_EQ(range_m, 0.0);
  EXPECT_EQ(result.counts.at("floor_untrusted"), 1);
}

TEST(SegmentService, LearnsFromRectanglesOnAnEarlierFrame) {
  const Outcome result = run({event(frame_number(0)), event(frame_number(1)), event(training_on(0)),
                              event(frame_number(2))},
                             gaussian());
  ASSERT_EQ(result.segments.size(), 3U);
  EXPECT_EQ(result.segments[1].model, "geometry");
  EXPECT_EQ(result.counts.at("model_not_in_force"), 2);
  EXPECT_EQ(result.counts.at("training_learned"), 1);
  EXPECT_EQ(result.segments[2].model, "gaussian");
  EXPECT_GT(result.segments[2].class_fraction_ratio[3], 0.3);
}

TEST(SegmentService, BadTrainingIsCountedAndTheOldModelStays) {
  segment_training_t outside = training_on(0);
  outside.rectangles[1].left_px = std::numeric_limits<std::int32_t>::max();
  segment_training_t missing = training_on(0);
  missing.rectangles.pop_back();
  missing.rectangle_count = 2;
  segment_training_t alike = training_on(0);
  alike.rectangles[1] = alike.rectangles[0];
  alike.rectangles[1].label = segmentation_t::LABEL_WALL;
  segment_training_t one_pixel = training_on(0);
  one_pixel.rectangles[1].width_px = one_pixel.rectangles[1].height_px = 1;
  segment_training_t elsewhere = training_on(0);
  elsewhere.train_frame_utime += 1;
  segment_training_t empty = training_on(0);
  empty.rectangles.clear();
  empty.rectangle_count = 0;
  const std::vector<LogEvent> good = {event(frame_number(0)), event(training_on(0)),
                                      event(frame_number(1))};
  std::vector<LogEvent> bad = {
      event(frame_number(0)), event(training_on(0)), event(outside),
      event(missing),         event(alike),          event(one_pixel),
      event(elsewhere),       event(empty),          event(frame_number(1))};
  const Outcome expected = run(good, gaussian());
  const Outcome result = run(bad, gaussian());
  ASSERT_EQ(result.segments.size(), 2U);
  EXPECT_EQ(result.events.back().data, expected.events.back().data);
  EXPECT_EQ(result.counts.at("training_outside_image"), 1);
  EXPECT_EQ(result.counts.at("training_class_missing"), 2);
  EXPECT_EQ(result.counts.at("training_classes_alike"), 1);
  EXPECT_EQ(result.counts.at("training_too_few_pixels"), 1);
  EXPECT_EQ(result.counts.at("training_frame_not_kept"), 1);
}

TEST(SegmentService, UsesTheModelFileAndAReplayLeavesItAlone) {
  const ScratchFolder folder;
  const auto path = folder.path() / "model.txt";
  segment::save_model(path, segment::taught_greys({{{60, 5}, {195, 5}, {125, 5}}}));
  const auto size = std::filesystem::file_size(path);
  const Outcome result =
      run({event(frame_number(0)), event(training_on(0)), event(frame_number(1))}, gaussian(path));
  EXPECT_EQ(result.segments[0].model, "gaussian");
  EXPECT_EQ(std::filesystem::file_size(path), size);
  EXPECT_EQ(segment::load_model(path).grey[0].mean_levels, 60.0);
}

TEST(SegmentService, WithoutAModelFileYetItStartsUntrained) {
  const Outcome result = run({event(frame_number(0))}, gaussian("/nowhere/model.txt"));
  ASSERT_EQ(result.segments.size(), 1U);
  EXPECT_EQ(result.segments[0].model, "geometry");
}

TEST(SegmentService, RefusesToStartOnADamagedModelFileByName) {
  const ScratchFolder folder;
  const auto path = folder.path() / "model.txt";
  std::ofstream(path) << "roomwise-segment-model 2\nclass 0";
  try {
    run({}, gaussian(path));
    FAIL() << "started";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find(path.string() + ": cut"), std::string::npos);
  }
}

/// A replay that claims to be live, so that what was learned is written.
class LiveBus : public LogBus {
 public:
  using LogBus::LogBus;
  bool is_replay() const override { return false; }
};

TEST(SegmentService, LiveItWritesWhatItLearnedAndSurvivesWhenItCannot) {
  const ScratchFolder folder;
  const std::vector<LogEvent> input = {event(frame_number(0)), event(training_on(0)),
                                       event(frame_number(1))};
  std::vector<LogEvent> output;
  LiveBus bus(input, output);
  const SegmentService service(bus, gaussian(folder.path() / "model.txt"));
  bus.run();
  EXPECT_GT(segment::load_model(folder.path() / "model.txt").grey[1].mean_levels, 150.0);

  std::vector<LogEvent> other_output;
  LiveBus other(input, other_output);
  const SegmentService unlucky(other, gaussian(folder.path() / "no" / "model.txt"));
  other.run();
  EXPECT_EQ(other_output.size(), 2U);
  EXPECT_EQ(other.statistics().counters.at("model_not_saved"), 1);
  EXPECT_NE(other.statistics().last_error.find("model.txt"), std::string::npos);
}

}  // namespace
}  // namespace roomwise
