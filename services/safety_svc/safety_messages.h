#pragma once
#include "roomwise/create_state_t.hpp"
#include "roomwise/kinect_frame_t.hpp"
#include "roomwise/odometry_t.hpp"
#include "roomwise/safety_state_t.hpp"
#include "roomwise/segmentation_t.hpp"
#include "roomwise/velocity_command_t.hpp"
#include "roomwise/velocity_request_t.hpp"
#include "services/safety_svc/core/decide.h"

namespace roomwise::safety {

/// Messages as the core takes them, and back. What refers to a message lives no longer than it.
OdometrySample sample_of(const odometry_t& message);
CameraSetup setup_of(const kinect_frame_t& message);
FloorView view_of(const segmentation_t& message);
BodyState body_of(const create_state_t& message);
Asked asked_of(const velocity_request_t& message);

/// The command without session, sequence and signature.
velocity_command_t command_of(const Instant& now, const Decision& decision);

/// Rewrites `message`, whose memory is used again.
void fill(const Instant& now, const World& world, const Decision& decision,
          safety_state_t& message);

}  // namespace roomwise::safety
