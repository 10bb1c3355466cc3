#pragma once
#include <filesystem>

#include "services/segment_svc/core/color/color_model.h"

namespace roomwise::segment {

/// Reads a trained model. Throws std::runtime_error "path: reason" if it cannot be read or is
/// refused.
ColorModel load_model(const std::filesystem::path& path);

/// Replaces the file as a whole or leaves it as it was: written beside it, flushed, then renamed.
/// Throws std::runtime_error naming the file.
void save_model(const std::filesystem::path& path, const ColorModel& model);

}  // namespace roomwise::segment
