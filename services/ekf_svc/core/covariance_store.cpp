#include "services/ekf_svc/core/covariance_store.h"

namespace roomwise::ekf {

void CovarianceStore::copy_column(std::size_t k, std::size_t n, double* column) const {
  for (std::size_t i = 0; i < k; ++i) column[i] = row(i)[k];
  std::copy(row(k) + k, row(k) + n, column + k);
}

}  // namespace roomwise::ekf
