#pragma once
#include <cstdint>

#include "common/image/rgbd_frame.h"
#include "services/simulator/device/frame_door_request.h"

namespace roomwise {

/// Frame `number` of a made camera that obeys `request`: a floor, a wall and a box that moves with
/// the number, in disparity steps as a Kinect has them, and its band without readings at the right.
/// (OpenNI2's .oni codec swaps an image's last run of equal pixels with a pixel after it that
/// differs, so that an image that ends in noise would come back wrong in its corner.) No two
/// frames, and no frame and its mirror image, are alike. Same arguments, same frame.
RgbdFrame made_frame(std::int64_t number, const simulator::FrameRequest& request = {});

/// The made camera shows so many different frames, again and again.
inline constexpr std::int64_t kMadeFrames = 12;

/// When the made camera takes frame `number`, on its own clock: at 30 Hz, from 5 s on.
std::int64_t made_device_time_us(std::int64_t number);

/// The number of the made frame taken at `device_time_us`.
std::int64_t made_number(std::int64_t device_time_us);

}  // namespace roomwise
