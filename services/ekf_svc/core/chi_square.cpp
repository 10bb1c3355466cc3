#include "services/ekf_svc/core/chi_square.h"

#include <cmath>

namespace roomwise::ekf {

double chi_square_quantile(int degrees_of_freedom, double normal) {
  const double a = 2.0 / (9.0 * degrees_of_freedom);
  const double root = 1.0 - a + normal * std::sqrt(a);
  return degrees_of_freedom * root * root * root;
}

}  // namespace roomwise::ekf
