#pragma once
#include <filesystem>
#include <vector>

#include "common/bus/log_event.h"

namespace roomwise {

/// Two seconds of a camera that turns slowly in a furnished room: KINECT_FRAME at 5 Hz, 320 x 240.
std::vector<LogEvent> made_frames();

/// Three seconds of a robot that drives an arc among known landmarks: ODOMETRY at 50 Hz and
/// LANDMARKS at 10 Hz.
std::vector<LogEvent> made_drive();

/// Writes `events` as a log.
void write_log(const std::filesystem::path& path, const std::vector<LogEvent>& events);

}  // namespace roomwise
