#pragma once

#include <array>

#include "base/vector.h"
#include "sky/atmosphere/spectrum.h"

namespace pleinair::sky {

/// The eight wavelengths of the atmosphere model, nm, evenly spaced. The ratio of a sky or sun
/// spectrum to the extraterrestrial sun's is smooth except for ozone. A natural cubic spline
/// through eight values agrees with 38 bands within 0.3 % in luminance and 0.0015 in chromaticity
/// on average (1.5 % and 0.04 at most, for suns and skies through 30 air masses of haze;
/// tests/sky/atmosphere/spectral_bands_test.cc).
inline constexpr double kFirstWavelengthNm = 420.0;
inline constexpr double kLastWavelengthNm = 720.0;
constexpr double WavelengthNm(int i) {
  return kFirstWavelengthNm + (kLastWavelengthNm - kFirstWavelengthNm) * i / (Spectrum::kSize - 1);
}

/// CIE XYZ of light whose spectrum is `ratio` times that of the sun outside the atmosphere at 1 au.
/// In lux for a ratio of irradiances, in cd/m² for a ratio of radiance to irradiance (1/sr).
Vec3 XyzOfSolarRatio(const Spectrum& ratio);

/// Absorption cross-section of ozone at 233 K, m² per molecule; wavelength 390…720 nm.
double OzoneCrossSection(double wavelength_nm);

/// Spectral irradiance of the sun at 1 au, W m⁻² nm⁻¹; wavelength 380…750 nm.
double SolarIrradiance(double wavelength_nm);

}  // namespace pleinair::sky
