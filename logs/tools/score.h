#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "logs/tools/recording.h"
#include "logs/tools/score_floor.h"

namespace roomwise {

/// Names and values in the order they are printed.
using Scores = std::vector<std::pair<std::string, double>>;

/// Everything the recording has the inputs for.
Scores score_recording(const Recording& recording);

/// Pooled over all pixels, and the mean of the frames' IoU. Empty if there are no frames.
Scores score_floor(const std::vector<FloorCounts>& frames);

/// A line "name value" each.
std::string scores_as_text(const Scores& scores);

/// One JSON object.
std::string scores_as_json(const Scores& scores);

}  // namespace roomwise
