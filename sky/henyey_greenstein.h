#pragma once

#include <algorithm>
#include <cmath>

namespace pleinair::sky {

/// Phase function of Henyey & Greenstein 1941, Eq. (2), for the cosine of the scattering angle. Its
/// mean over the sphere is 1.
inline double HenyeyGreenstein(double asymmetry, double cosine) {
  const double g2 = asymmetry * asymmetry;
  const double base = std::max(1e-9, 1.0 + g2 - 2.0 * asymmetry * cosine);
  return (1.0 - g2) / (base * std::sqrt(base));
}

}  // namespace pleinair::sky
