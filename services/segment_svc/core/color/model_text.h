#pragma once
#include <string>
#include <string_view>
#include <variant>

#include "services/segment_svc/core/color/color_model.h"

namespace roomwise::segment {

/// A trained model as a small text that reads back exactly. A part of a mixture is its weight, its
/// mean, and the lower triangle of its covariance row by row:
///
///   roomwise-segment-model 2
///   class 0 mean_levels 31.25 sigma_levels 12.5
///   part 0.75 0.1 -0.2 3.5 0.01 0 0.01 0 0 0.04
///   part 0.25 ...
///   class 100 ...
///   class 200 ...
///   crc32 0a1b2c3d                                   of all lines before
std::string format_model(const ColorModel& model);

enum class ModelFault {
  kForeign,  ///< not a segmentation model
  kVersion,  ///< of another version
  kCut,      ///< no CRC at its end
  kDamaged,  ///< the CRC differs
  kValues,   ///< not three classes of 1 to kMixturePartsMax Gaussians with sound values
};

/// A fault in words, to be put behind a file's name.
std::string_view reason_of(ModelFault fault);

/// Reads format_model's text. Anything else is refused.
std::variant<ColorModel, ModelFault> parse_model(std::string_view text);

}  // namespace roomwise::segment
