#pragma once
#include <string_view>
#include <tuple>

#include "roomwise/all_messages.hpp"

namespace roomwise {

/// A channel's name and the one type it carries; the rest is documentation that README.md repeats
/// (scripts/check compares the two).
template <class Message>
struct Channel {
  std::string_view name;
  std::string_view rate_hz;
  std::string_view publisher;
  std::string_view readers;
};

/// The only place where a channel meets its type, publisher and readers. One line a channel.
namespace channels {
// clang-format off
inline constexpr Channel<kinect_frame_t> kKinectFrame{"KINECT_FRAME", "30", "kinect_pub", "landmark_svc, segment_svc, safety_svc, viewer"};
inline constexpr Channel<device_status_t> kKinectStatus{"KINECT_STATUS", "1 + on change", "kinect_pub", "viewer, rwlog"};
inline constexpr Channel<landmark_list_t> kLandmarks{"LANDMARKS", "<= 30", "landmark_svc", "ekf_svc, viewer"};
inline constexpr Channel<segmentation_t> kSegments{"SEGMENTS", "<= 30", "segment_svc", "safety_svc, pilot_svc, viewer"};
inline constexpr Channel<segment_training_t> kSegmentTrain{"SEGMENT_TRAIN", "on event", "viewer, rwlog", "segment_svc"};
inline constexpr Channel<create_state_t> kCreateState{"CREATE_STATE", "66", "create_driver", "safety_svc, viewer"};
inline constexpr Channel<odometry_t> kOdometry{"ODOMETRY", "66", "create_driver", "landmark_svc, ekf_svc, safety_svc, pilot_svc, viewer"};
inline constexpr Channel<velocity_command_t> kVelCmd{"VEL_CMD", "50", "safety_svc", "create_driver"};
inline constexpr Channel<velocity_request_t> kVelRequest{"VEL_REQUEST", "10 to 20", "pilot_svc, viewer", "safety_svc"};
inline constexpr Channel<safety_state_t> kSafetyState{"SAFETY_STATE", "10 + on change", "safety_svc", "all"};
inline constexpr Channel<estop_t> kEstop{"ESTOP", "on press, 2 while held", "viewer", "safety_svc"};
inline constexpr Channel<safety_reset_t> kSafetyReset{"SAFETY_RESET", "on press", "viewer", "safety_svc"};
inline constexpr Channel<pilot_goal_t> kPilotGoal{"PILOT_GOAL", "on event", "viewer", "pilot_svc"};
inline constexpr Channel<pilot_state_t> kPilotState{"PILOT_STATE", "5 + on change", "pilot_svc", "viewer"};
inline constexpr Channel<pose_t> kPose{"POSE", ">= 30", "ekf_svc", "all"};
inline constexpr Channel<landmark_map_t> kLandmarkMap{"LANDMARK_MAP", "1 + on change", "ekf_svc", "pilot_svc, viewer, rwlog"};
inline constexpr Channel<truth_t> kTruth{"TRUTH", "60", "simulator", "viewer, rwlog"};
inline constexpr Channel<segmentation_t> kTrueSegments{"TRUE_SEGMENTS", "30, if asked for", "simulator", "rwlog"};
inline constexpr Channel<health_t> kHealth{"HEALTH", "1", "every process", "viewer, rwlog"};
inline constexpr Channel<params_t> kParams{"PARAMS", "1", "every process", "viewer, rwlog"};
// clang-format on
}  // namespace channels

/// Every channel, for tools that must treat them all.
inline constexpr auto kAllChannels = std::make_tuple(
    channels::kKinectFrame, channels::kKinectStatus, channels::kLandmarks, channels::kSegments,
    channels::kSegmentTrain, channels::kCreateState, channels::kOdometry, channels::kVelCmd,
    channels::kVelRequest, channels::kSafetyState, channels::kEstop, channels::kSafetyReset,
    channels::kPilotGoal, channels::kPilotState, channels::kPose, channels::kLandmarkMap,
    channels::kTruth, channels::kTrueSegments, channels::kHealth, channels::kParams);

}  // namespace roomwise
