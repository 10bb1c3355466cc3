#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>

#include "services/segment_svc/core/grey_gaussians.h"

namespace roomwise::segment {

/// CRC-32 of PNG and zlib (ISO 3309: polynomial 0xedb88320, reflected, all ones before and after).
std::uint32_t crc32_of(std::string_view text);

/// A trained model as a small text that reads back exactly:
///
///   roomwise-segment-model 1 gaussian
///   class 0 mean_levels 31.25 sigma_levels 12.5
///   class 100 ...
///   class 200 ...
///   crc32 0a1b2c3d                                   of all lines before
std::string format_model(const GreyClassifier::Gaussians& gaussians);

enum class ModelFault {
  kForeign,  ///< not a segmentation model
  kVersion,  ///< of another version or kind
  kCut,      ///< no CRC at its end
  kDamaged,  ///< the CRC differs
  kValues,   ///< not three classes with means in [0, 255] and sigmas in [kSigmaMin_levels, 255]
};

/// A fault in words, to be put behind a file's name.
std::string_view reason_of(ModelFault fault);

/// Reads format_model's text. Anything else is refused.
std::variant<GreyClassifier::Gaussians, ModelFault> parse_model(std::string_view text);

}  // namespace roomwise::segment
