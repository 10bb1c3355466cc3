#pragma once
#include <cstddef>

#include "common/channels.h"
#include "services/landmark_svc/core/landmark_detector.h"

namespace roomwise {

/// One element of LANDMARKS.
landmark_observation_t to_message(const landmark::Landmark& landmark);

/// Fills LANDMARKS with what `detector` found in `frame`, reusing the message's memory. At most
/// `edge_pixels_listed_max` edge pixels are listed, evenly thinned; all are counted. Every reason
/// for rejection is listed, with 0 where it did not apply.
void fill_message(const landmark::LandmarkDetector& detector, const RgbdFrame& frame,
                  landmark_list_t& message);

}  // namespace roomwise
