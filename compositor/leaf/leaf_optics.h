#pragma once

#include "base/vector.h"

namespace pleinair::compositor {

/// Directional-hemispherical reflectance and transmittance at one wavelength.
struct LeafOptics {
  double reflectance = 0.0, transmittance = 0.0;
};

/// The same as colors: linear Rec.709 relative to a white diffuser in the same light, which is
/// (1, 1, 1). Not clipped: a saturated color has channels below zero.
struct LeafColors {
  LinearRgb reflectance, transmittance;
};

}  // namespace pleinair::compositor
