#pragma once

#include <array>
#include <cstddef>

#include "base/vector.h"
#include "sky/cie_observer.h"

namespace pleinair::compositor {

/// Wavelengths at which the colors of leaves are computed: every 10 nm from 400 to 750 nm, those of
/// sky::kCie1931 for which leaves have data.
inline constexpr std::size_t kLightBands = 36;
inline constexpr std::size_t kFirstLightBand = sky::kCie1931.size() - kLightBands;
constexpr double LightBandNm(std::size_t i) {
  return sky::kCie1931[kFirstLightBand + i].wavelength_nm;
}

/// A spectral power distribution at these wavelengths; its scale has no meaning.
using LightSpectrum = std::array<double, kLightBands>;

/// CIE standard illuminant D65 (CIE 15:2004, Table T.1).
const LightSpectrum& D65Spectrum();

/// Color of a spectrum under the CIE 1931 observer, linear Rec.709, not clipped to the gamut.
LinearRgb ColorOfSpectrum(const LightSpectrum& spectrum);

/// Returns a spectrum of daylight with the chromaticity of `light` (linear Rec.709). It is the
/// spectrum of the sun outside the atmosphere times exp(c₁ u + c₂ u²), u = (λ − 560 nm) / 160 nm.
/// Scattering by air and haze, and thus the light of sun and sky, have this form. The absorption by
/// ozone has not. Colors of leaves differ by less than 0.01 from those under the spectra of the
/// atmosphere model (tests/compositor/leaf/leaf_color_test.cc). Channels below 2 % of the largest
/// count as 2 %. Black and values that are not finite give D65.
LightSpectrum DaylightSpectrum(LinearRgb light);

}  // namespace pleinair::compositor
