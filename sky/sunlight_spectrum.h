#pragma once

#include "base/units.h"
#include "base/vector.h"

namespace pleinair::sky {

/// Direct sunlight after atmospheric extinction, on a surface facing the sun: lux, linear Rec.709,
/// clipped to the gamut.
///
/// Direct spectral irradiance after Iqbal 1983, "An Introduction to Solar Radiation", ch. 6, with
/// the amounts of Preetham et al. 1999, appendix A.1: Rayleigh scattering, Ångström's aerosol
/// (exponent 1.3, amount by turbidity), 0.35 cm of ozone, 2 cm of water vapour (mixed gases absorb
/// beyond 750 nm only). Weighted with the CIE 1931 observer. `apparent_elevation` includes
/// refraction.
LinearRgb DirectSunIrradiance(double turbidity, Radians apparent_elevation, double distance_au);

}  // namespace pleinair::sky
