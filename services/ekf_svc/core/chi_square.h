#pragma once

namespace roomwise::ekf {

/// Quantiles of the standard normal distribution.
inline constexpr double kNormal95 = 1.6449;
inline constexpr double kNormal975 = 1.9600;
inline constexpr double kNormal99 = 2.3263;

/// chi^2 quantile where the standard normal one is `normal`, within 0.2 % (Wilson, Hilferty, PNAS
/// 1931): k (1 - a + normal sqrt(a))^3, a = 2 / (9 k). `degrees_of_freedom` > 0.
double chi_square_quantile(int degrees_of_freedom, double normal);

}  // namespace roomwise::ekf
