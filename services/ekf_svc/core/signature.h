#pragma once
#include "services/ekf_svc/core/landmark.h"

namespace roomwise::ekf {

/// How far two signatures are apart: a sum of squares of `degrees_of_freedom` normal variables, if
/// they are of the same surface. Without colour on both sides: (0, 0).
struct SignatureDistance {
  double squared = 0.0;
  int degrees_of_freedom = 0;
};
SignatureDistance distance(const Signature& a, const Signature& b);

/// The signature itself if it says anything, else one without colour.
Signature cleaned(const Signature& signature);

/// The mean of both, weighted by inverse variance.
Signature fused(const Signature& a, const Signature& b);

}  // namespace roomwise::ekf
