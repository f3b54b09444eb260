#include "compositor/leaf/light_spectrum.h"

#include <algorithm>
#include <cmath>

#include "base/vector.h"
#include "sky/atmosphere/spectral_bands.h"
#include "sky/color.h"

namespace pleinair::compositor {
namespace {

constexpr LightSpectrum kD65 = {
    82.7549, 91.4860, 93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861, 115.923,
    108.811, 109.354, 107.802, 104.790, 107.689, 104.405, 104.046, 100.000, 96.3342,
    95.7880, 88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268, 80.2146,
    82.2778, 78.2842, 69.7213, 71.6091, 74.3490, 61.6040, 69.8856, 75.0870, 63.5927};

constexpr double kMinChannelShare = 0.02;

Vec3 XyzOfSpectrum(const LightSpectrum& spectrum) {
  Vec3 xyz;
  for (std::size_t i = 0; i < kLightBands; ++i) {
    const sky::ObserverBand& band = sky::kCie1931[kFirstLightBand + i];
    xyz = xyz + Vec3{band.x, band.y, band.z} * spectrum[i];
  }
  return xyz;
}

/// x and y of the chromaticity.
Vec2 ChromaticityOf(Vec3 xyz) {
  const double sum = xyz.x + xyz.y + xyz.z;
  return {xyz.x / sum, xyz.y / sum};
}

/// The spectrum for the coefficients c₁ and c₂.
LightSpectrum FilteredSun(Vec2 c) {
  LightSpectrum spectrum;
  for (std::size_t i = 0; i < kLightBands; ++i) {
    const double u = (LightBandNm(i) - 560.0) / 160.0;
    spectrum[i] = sky::SolarIrradiance(LightBandNm(i)) * std::exp((c.x + c.y * u) * u);
  }
  return spectrum;
}

}  // namespace

const LightSpectrum& D65Spectrum() { return kD65; }

LinearRgb ColorOfSpectrum(const LightSpectrum& spectrum) {
  const Vec3 xyz = XyzOfSpectrum(spectrum);
  return sky::RgbFromXyz(xyz.x, xyz.y, xyz.z);
}

LightSpectrum DaylightSpectrum(LinearRgb light) {
  const double largest = std::max({light.r, light.g, light.b});
  if (!(largest > 0.0) || !std::isfinite(light.r + light.g + light.b)) return kD65;
  const double least = kMinChannelShare * largest;
  const Vec2 wanted = ChromaticityOf(sky::XyzFromRgb(
      {std::max(light.r, least), std::max(light.g, least), std::max(light.b, least)}));
  // Newton's method on the chromaticity, with short steps: suns of one air mass to sunset lie
  // within ±4.
  constexpr int kSteps = 40;
  constexpr double kMaxStep = 0.5, kMaxCoefficient = 6.0, kProbe = 1e-4;
  Vec2 c;
  for (int step = 0; step < kSteps; ++step) {
    const Vec2 at = ChromaticityOf(XyzOfSpectrum(FilteredSun(c)));
    const Vec2 missing = wanted - at;
    if (Norm(missing) < 1e-9) break;
    const Vec2 dx = ChromaticityOf(XyzOfSpectrum(FilteredSun({c.x + kProbe, c.y}))) - at;
    const Vec2 dy = ChromaticityOf(XyzOfSpectrum(FilteredSun({c.x, c.y + kProbe}))) - at;
    const double determinant = dx.x * dy.y - dx.y * dy.x;
    if (std::abs(determinant) < 1e-18) break;
    const Vec2 change =
        Vec2{missing.x * dy.y - missing.y * dy.x, dx.x * missing.y - dx.y * missing.x} *
        (kProbe / determinant);
    const double length = Norm(change);
    c = c + change * (length > kMaxStep ? kMaxStep / length : 1.0);
    c = {std::clamp(c.x, -kMaxCoefficient, kMaxCoefficient),
         std::clamp(c.y, -kMaxCoefficient, kMaxCoefficient)};
  }
  return FilteredSun(c);
}

}  // namespace pleinair::compositor
