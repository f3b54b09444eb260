#pragma once

#include <cmath>

namespace pleinair::compositor {

// Student's distribution of residuals, whose tails take outliers: K. L. Lange, R. J. A. Little,
// J. M. G. Taylor: Robust statistical modeling using the t distribution, 1989.

/// Negative logarithm of the density at `value`, less that at 0.
inline double StudentCost(double value, double scale, double freedom) {
  const double z = value / scale;
  return 0.5 * (freedom + 1.0) * std::log1p(z * z / freedom);
}

/// Weight of a value in iteratively reweighted least squares, beside that of a normal distribution
/// of the same scale.
inline double StudentWeight(double value, double scale, double freedom) {
  const double z = value / scale;
  return (freedom + 1.0) / (freedom + z * z);
}

}  // namespace pleinair::compositor
