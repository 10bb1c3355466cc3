#include "services/landmark_svc/landmark_service.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "common/bus/log_bus.h"
#include "common/frames/frame_encoder.h"
#include "common/params/params.h"
#include "tests/support/events.h"
#include "tests/support/synthetic_room.h"

namespace roomwise {
namespace {

struct Outcome {
  std::vector<LogEvent> events;
  std::vector<landmark_list_t> lists;
  BusStatistics statistics;
};

Outcome run(const std::vector<kinect_frame_t>& frames, const LandmarkService::Params& params = {}) {
  std::vector<LogEvent> input;
  for (const auto& frame : frames) {
    input.push_back(event_of(channels::kKinectFrame, frame.utime, frame));
  }
  Outcome outcome;
  LogBus bus(input, outcome.events);
  LandmarkService service(bus, params);
  bus.run();
  outcome.statistics = bus.statistics();
  for (const LogEvent& event : outcome.events) {
    EXPECT_EQ(event.channel, channels::kLandmarks.name);
    EXPECT_EQ(decode(event.data, outcome.lists.emplace_back()), DecodeResult::kOk);
  }
  return outcome;
}

kinect_frame_t message_of(const RgbdFrame& frame, std::int64_t utime, std::int64_t seq) {
  kinect_frame_t message{};
  FrameEncoder encoder;
  encoder.encode_depth(frame.depth, kinect_frame_t::DEPTH_PDZ16, message);
  encoder.encode_color(frame.color, kinect_frame_t::COLOR_RGB8, 90, message);
  encode_depth_camera(frame.depth_camera, message);
  encode_color_camera(frame.color_camera, message);
  encode_pose(frame.T_robot_camera, message);
  message.depth_registered = 1;
  message.utime = utime;
  message.seq = seq;
  return message;
}

const RgbdFrame& furnished_frame() {
  static const RgbdFrame frame = render(furnished_room(), {}, {0.2, -0.2, 0.05}, 0);
  return frame;
}

const kinect_frame_t& furnished_message() {
  static const kinect_frame_t message = message_of(furnished_frame(), 1'000'000, 5);
  return message;
}

TEST(LandmarkService, SaysWhatItFoundAndWhatWasInForce) {
  const Outcome outcome = run({furnished_message()});
  ASSERT_EQ(outcome.lists.size(), 1u);
  const landmark_list_t& list = outcome.lists[0];
  EXPECT_EQ(list.utime, 1'000'000);
  EXPECT_EQ(list.frame_seq, 5);
  EXPECT_EQ(list.width_px, 640);
  EXPECT_EQ(list.height_px, 480);
  EXPECT_GE(list.count, 3);  // two edges of the box and the pole
  EXPECT_GT(list.scan_count, 500);
  EXPECT_EQ(list.alpha_ratio, 0.0);
  EXPECT_EQ(list.beta_ratio, 1.0);
  EXPECT_EQ(list.threshold_mm_per_px, 0.0);
  EXPECT_EQ(list.threshold_quanta, 4.0);
  EXPECT_EQ(list.range_min_m, 0.6);
  EXPECT_EQ(list.range_max_m, 3.81);
  ASSERT_EQ(list.rejection_count, 16);
  EXPECT_EQ(list.rejections[0].name, "edge_out_of_range");
  for (const auto& landmark : list.landmarks) {
    EXPECT_EQ(landmark.identity, -1);
    EXPECT_EQ(landmark.moving, 0);
    const bool is_crease = landmark.kind == landmark_observation_t::KIND_CREASE_CONVEX ||
                           landmark.kind == landmark_observation_t::KIND_CREASE_CONCAVE;
    if (!is_crease) {
      EXPECT_LT(landmark.chroma_variance_log2, 0.05);
    }
  }
}

TEST(LandmarkService, ThesisMethodStatesItsOwnNumbers) {
  LandmarkService::Params params;
  apply_toml("method = 'thesis'\nthreshold_mm_per_px = 1000.0", "test", ParamFields(params));
  const Outcome outcome = run({furnished_message()}, params);
  ASSERT_EQ(outcome.lists.size(), 1u);
  const landmark_list_t& list = outcome.lists[0];
  EXPECT_GT(list.alpha_ratio, 0.0);
  EXPECT_DOUBLE_EQ(list.alpha_ratio + list.beta_ratio, 1.0);
  EXPECT_EQ(list.threshold_mm_per_px, 1000.0);
  EXPECT_EQ(list.threshold_quanta, 0.0);
  EXPECT_EQ(list.range_min_m, 1.22);
}

TEST(LandmarkService, ListsEdgePixelsEvenlyThinned) {
  LandmarkService::Params params;
  params.edge_pixels_listed_max = 100;
  const landmark_list_t all = run({furnished_message()}).lists.at(0);
  const landmark_list_t thinned = run({furnished_message()}, params).lists.at(0);
  EXPECT_EQ(all.edge_listed, all.edge_count);
  EXPECT_EQ(thinned.edge_count, all.edge_count);
  ASSERT_EQ(thinned.edge_listed, 100);
  EXPECT_LT(thinned.edge_v_px.front(), all.edge_v_px.front() + 20);
  EXPECT_GT(thinned.edge_v_px.back(), all.edge_v_px.back() - 20);
  params.edge_pixels_listed_max = 0;
  EXPECT_EQ(run({furnished_message()}, params).lists.at(0).edge_listed, 0);
}

TEST(LandmarkService, OneListForEachGoodFrameAndACountForEachBadOne) {
  kinect_frame_t bad_depth = furnished_message();
  bad_depth.depth_data.resize(7);
  bad_depth.depth_size = 7;
  kinect_frame_t bad_pose = furnished_message();
  bad_pose.T_robot_camera_quat[0] = std::numeric_limits<double>::quiet_NaN();
  const Outcome outcome =
      run({furnished_message(), bad_depth, furnished_message(), bad_pose, furnished_message()});
  ASSERT_EQ(outcome.lists.size(), 3u);
  EXPECT_EQ(outcome.lists[2].seq, 3);
  EXPECT_EQ(outcome.statistics.counters.at("frame_bad_depth"), 1);
  EXPECT_EQ(outcome.statistics.counters.at("frame_bad_pose"), 1);
}

TEST(LandmarkService, SameFramesSameBytes) {
  const std::vector<kinect_frame_t> frames(3, furnished_message());
  const Outcome once = run(frames);
  const Outcome again = run(frames);
  ASSERT_EQ(once.events.size(), again.events.size());
  for (std::size_t i = 0; i < once.events.size(); ++i) {
    EXPECT_EQ(once.events[i].data, again.events[i].data);
  }
}

TEST(LandmarkService, WithoutColorLandmarksAreTheSameButForTheirColor) {
  RgbdFrame frame = furnished_frame();
  frame.color = {};
  const auto plain = run({message_of(frame, 1, 1)}).lists.at(0);
  const auto colored = run({furnished_message()}).lists.at(0);
  LandmarkService::Params params;
  params.use_color = false;
  const auto skipped = run({furnished_message()}, params).lists.at(0);
  ASSERT_EQ(plain.count, colored.count);
  ASSERT_EQ(skipped.count, colored.count);
  for (std::size_t i = 0; i < plain.landmarks.size(); ++i) {
    EXPECT_EQ(plain.landmarks[i].range_m, colored.landmarks[i].range_m);
    EXPECT_GT(plain.landmarks[i].chroma_variance_log2, 1000.0);
    EXPECT_GT(skipped.landmarks[i].chroma_variance_log2, 1000.0);
  }
}

bool is_finite(const landmark_list_t& list) {
  for (const auto& seen : list.landmarks) {
    for (const double value :
         {seen.range_m, seen.bearing_rad, seen.covariance_range_range_m2,
          seen.covariance_range_bearing_m_rad, seen.covariance_bearing_bearing_rad2,
          seen.height_low_m, seen.height_high_m, seen.step_m, seen.chroma_red_log,
          seen.chroma_blue_log, seen.chroma_variance_log2, seen.score_ratio, seen.pixel_u_px,
          seen.pixel_v_top_px, seen.pixel_v_bottom_px}) {
      if (!std::isfinite(value)) return false;
    }
  }
  return std::isfinite(list.alpha_ratio) && std::isfinite(list.beta_ratio);
}

RC_GTEST_PROP(LandmarkService, HostileFramesAreCountedOrGiveFiniteLists, ()) {
  const auto wild = [](double usual) {
    return *rc::gen::element(usual, usual, usual, usual, 0.0, -1.0, 1e-300, 1e9, 1e300, -1e300,
                             std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN());
  };
  kinect_frame_t message = furnished_message();
  message.utime = *rc::gen::element<std::int64_t>(1, 0, -5);
  message.depth_unit_m = wild(message.depth_unit_m);
  message.depth_fx_px = wild(message.depth_fx_px);
  message.depth_fy_px = wild(message.depth_fy_px);
  message.depth_cx_px = wild(message.depth_cx_px);
  for (double& value : message.T_robot_camera_translation_m) value = wild(value);
  if (*rc::gen::inRange(0, 4) == 0) message.depth_width_px = *rc::gen::arbitrary<int>();
  if (*rc::gen::inRange(0, 4) == 0) message.color_encoding = *rc::gen::arbitrary<std::int8_t>();
  const Outcome outcome = run({message});
  std::int64_t counted = 0;
  for (const auto& [name, count] : outcome.statistics.counters) counted += count;
  RC_ASSERT(static_cast<std::int64_t>(outcome.lists.size()) + counted == 1);
  for (const landmark_list_t& list : outcome.lists) RC_ASSERT(is_finite(list));
}

}  // namespace
}  // namespace roomwise
