#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "services/segment_svc/core/grey_gaussians.h"

namespace roomwise::segment {

/// A trained model as a small text: a line that names format and version, a line per class, and the
/// CRC-32 (as zlib has it) of all lines before its own.
std::string format_model(const GreyClassifier::Gaussians& gaussians);

/// Reads format_model's text back exactly. Throws std::runtime_error "source: reason" if the text
/// is of another kind or version, cut, changed, or holds values a model cannot have.
GreyClassifier::Gaussians parse_model(std::string_view text, std::string_view source);

/// Throws std::runtime_error naming the file.
GreyClassifier::Gaussians load_model(const std::filesystem::path& path);

/// Replaces the file as a whole or leaves it as it was: written beside it, flushed, then renamed.
/// Throws std::runtime_error naming the file.
void save_model(const std::filesystem::path& path, const GreyClassifier::Gaussians& gaussians);

}  // namespace roomwise::segment
