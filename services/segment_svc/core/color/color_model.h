#pragma once
#include <array>

#include "services/segment_svc/core/color/grey_gaussians.h"
#include "services/segment_svc/core/color/mixture.h"
#include "services/segment_svc/core/labels.h"

namespace roomwise::segment {

/// No mixture of a model has more parts.
inline constexpr int kMixturePartsMax = 5;

/// A mixture for each of kTrainedClasses.
using ClassMixtures = std::array<Mixture, kTrainedClasses.size()>;

/// What a person taught: how each of kTrainedClasses looks.
struct ColorModel {
  GreyClassifier::Gaussians grey;  ///< the thesis's one Gaussian over grey levels
  ClassMixtures mixtures;          ///< over ColorFeature
};

}  // namespace roomwise::segment
