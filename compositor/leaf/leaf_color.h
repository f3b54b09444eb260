#pragma once

#include <array>

#include "compositor/leaf/leaf_optics.h"
#include "compositor/leaf/light_spectrum.h"
#include "scene/leaf_contents.h"

namespace pleinair::compositor {

/// The light on leaves, as the CIE 1931 observer sees it. A reflectance spectrum ρ becomes the
/// channel ratios RGB(S ρ) / RGB(S): multiplied by the light's own color they give the color of
/// the reflected light.
class LeafIlluminant {
 public:
  explicit LeafIlluminant(const LightSpectrum& spectrum);
  /// CIE D65.
  static const LeafIlluminant& D65();
  /// Daylight of a color, linear Rec.709 (DaylightSpectrum()).
  static LeafIlluminant OfLight(LinearRgb light) { return LeafIlluminant(DaylightSpectrum(light)); }

  LinearRgb Ratio(const LightSpectrum& reflectance) const;

 private:
  std::array<LightSpectrum, 3> weights_;  // The weights of each channel sum to 1.
};

/// Colors of a leaf in a light. `thickness` scales all contents. kPlate has three wavelengths
/// alone and ignores the light. Not clipped.
LeafColors ColorsOfLeaf(const scene::Leaf& leaf, const LeafIlluminant& light,
                        double thickness = 1.0);

}  // namespace pleinair::compositor
