#include "compositor/leaf/leaf_color.h"

#include <cstddef>

#include "compositor/leaf/plate.h"
#include "compositor/leaf/prospect.h"

namespace pleinair::compositor {

LeafIlluminant::LeafIlluminant(const LightSpectrum& spectrum) {
  const LinearRgb white = ColorOfSpectrum(spectrum);
  for (std::size_t i = 0; i < kLightBands; ++i) {
    LightSpectrum band{};
    band[i] = spectrum[i];
    const LinearRgb ratio = ColorOfSpectrum(band) / white;
    weights_[0][i] = ratio.r;
    weights_[1][i] = ratio.g;
    weights_[2][i] = ratio.b;
  }
}

const LeafIlluminant& LeafIlluminant::D65() {
  static const LeafIlluminant kD65Illuminant(D65Spectrum());
  return kD65Illuminant;
}

LinearRgb LeafIlluminant::Ratio(const LightSpectrum& reflectance) const {
  LinearRgb ratio;
  for (std::size_t i = 0; i < kLightBands; ++i) {
    ratio = ratio + LinearRgb{weights_[0][i], weights_[1][i], weights_[2][i]} * reflectance[i];
  }
  return ratio;
}

LeafColors ColorsOfLeaf(const scene::Leaf& leaf, const LeafIlluminant& light, double thickness) {
  if (leaf.model == scene::LeafModel::kPlate) return PlateColors(leaf, thickness);
  LightSpectrum reflectance, transmittance;
  for (std::size_t i = 0; i < kLightBands; ++i) {
    const LeafBand& band = LeafBandAt(static_cast<int>(LightBandNm(i)));
    const LeafOptics optics =
        StackOptics(band, thickness * OpticalDepth(band, leaf.contents), leaf.contents.structure);
    reflectance[i] = optics.reflectance;
    transmittance[i] = optics.transmittance;
  }
  return {light.Ratio(reflectance), light.Ratio(transmittance)};
}

}  // namespace pleinair::compositor
