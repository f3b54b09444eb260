#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "scene/leaf_contents.h"

namespace pleinair::compositor {

/// A leaf's spectrum as an integrating sphere measures it. The lists are of equal length; one of
/// `reflectance` and `transmittance` may be empty. Wavelengths: kFirstLeafNm…kLastLeafNm.
struct MeasuredSpectrum {
  std::vector<double> wavelength_nm, reflectance, transmittance;
};

/// The smallest number of wavelengths that determines a leaf.
inline constexpr std::size_t kMinFittedBands = 10;

/// The contents that explain a spectrum.
struct LeafFit {
  scene::LeafContents contents;
  /// Standard deviations of the values of scene::kLeafQuantities, from the residuals. Empty where
  /// the measured wavelengths do not determine the value, which is then 0.
  std::array<std::optional<double>, scene::kLeafQuantities.size()> deviations;
  double rms = 0.0;  ///< Root mean square of the residuals.
};

/// Inverts PROSPECT-D by least squares (Ceres, bounded to the ranges of scene::kLeafQuantities)
/// from several starts and returns the best. Takes 0.1 s for 2,101 wavelengths. Errors (input): too
/// few wavelengths; no start converges. `where` names the spectrum in errors.
Result<LeafFit> FitLeaf(const MeasuredSpectrum& spectrum, const std::string& where);

}  // namespace pleinair::compositor
