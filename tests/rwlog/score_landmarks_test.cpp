#include "logs/tools/score_landmarks.h"

#include <gtest/gtest.h>

#include "roomwise/landmark_observation_t.hpp"
#include "tests/rwlog/poses.h"

namespace roomwise {
namespace {

using Observation = landmark_observation_t;

constexpr std::int64_t kUtime = 1'000'000;

/// Corners 1, 2 and 5 m ahead of the robot; a frame that sees a wall through the first two.
Recording recording_at(const Pose2& T_world_robot) {
  Recording recording;
  recording.truth = {{kUtime, T_world_robot}};
  for (const double ahead_m : {1.0, 2.0, 5.0}) {
    recording.true_landmarks.push_back(
        {-1, transform(T_world_robot, {ahead_m, 0.0}), Observation::KIND_CREASE_CONVEX});
  }
  SeenFrame frame;
  frame.utime = kUtime;
  frame.range_min_m = 0.6;
  frame.range_max_m = 3.8;
  frame.scan_robot_m = {{1.0, 0.04}, {2.0, -0.04}, {5.0, 0.0}};
  recording.seen_frames = {frame};
  return recording;
}

void see(Recording& recording, std::int8_t kind, double ahead_m, bool moving = false) {
  recording.seen_frames[0].landmarks.push_back({kUtime, kind, moving, {ahead_m, 0.0}});
}

RC_GTEST_PROP(ScoreLandmarks, CountsFromAnyPose, ()) {
  Recording recording = recording_at(*any_pose());
  see(recording, Observation::KIND_EDGE_LEFT, 1.02);
  see(recording, Observation::KIND_CREASE_CONVEX, 1.01);
  see(recording, Observation::KIND_CREASE_CONCAVE, 2.0);  // of no such kind
  see(recording, Observation::KIND_CREASE_CONVEX, 2.0, true);
  const LandmarkScore score = score_landmarks(recording);
  RC_ASSERT(score.seen == 3U);
  RC_ASSERT(score.moving == 1U);
  RC_ASSERT(score.matches.size() == 2U);
  RC_ASSERT(std::abs(score.precision_ratio() - 2.0 / 3.0) < 1e-12);
}

RC_GTEST_PROP(ScoreLandmarks, WhatIsInSightAndInRangeIsFoundOnceOrMissed, ()) {
  Recording recording = recording_at(*any_pose());
  see(recording, Observation::KIND_EDGE_LEFT, 1.02);
  see(recording, Observation::KIND_CREASE_CONVEX, 1.01);
  see(recording, Observation::KIND_CREASE_CONVEX, 5.0);  // beyond the range
  const LandmarkScore score = score_landmarks(recording);
  RC_ASSERT(score.in_sight == 2U);
  RC_ASSERT(score.found == 1U);
  RC_ASSERT(score.found_ratio() == 0.5);
}

TEST(ScoreLandmarks, WhatIsHiddenIsNotInSight) {
  Recording recording = recording_at(Pose2{});
  recording.seen_frames[0].scan_robot_m = {{0.9, 0.0}, {1.9, 0.0}};
  EXPECT_EQ(score_landmarks(recording).in_sight, 0U);
  EXPECT_EQ(score_landmarks(recording).found_ratio(), 0.0);
}

TEST(ScoreLandmarks, FramesWithoutATruePoseAreLeftOut) {
  Recording recording = recording_at(Pose2{});
  recording.seen_frames[0].utime += 10'000'000;
  EXPECT_EQ(score_landmarks(recording).frames, 0U);
  EXPECT_EQ(score_landmarks(recording).in_sight, 0U);
}

}  // namespace
}  // namespace roomwise
