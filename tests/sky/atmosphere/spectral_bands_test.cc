#include "sky/atmosphere/spectral_bands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sky/atmosphere/air_medium.h"
#include "sky/cie_observer.h"
#include "sky/color.h"

namespace pleinair::sky {
namespace {

/// The sun's light after each wavelength is multiplied by f.
template <typename Function>
XyY WithAllBands(const Function& f) {
  Vec3 xyz;
  for (const ObserverBand& band : kCie1931) {
    const double watts = kLumensPerWatt * kObserverStepNm * SolarIrradiance(band.wavelength_nm) *
                         f(band.wavelength_nm);
    xyz = xyz + Vec3{band.x, band.y, band.z} * watts;
  }
  return XyYFromXyz(xyz);
}

template <typename Function>
XyY WithEightBands(const Function& f) {
  Spectrum ratio;
  for (int i = 0; i < Spectrum::kSize; ++i) ratio.v[i] = static_cast<float>(f(WavelengthNm(i)));
  return XyYFromXyz(XyzOfSolarRatio(ratio));
}

TEST(Spectrum, HasAnExponentialAsGoodAsItsArgument) {
  for (double x = 0.0; x > -87.0; x -= 0.0137) {
    ASSERT_NEAR(ExpOfNegative(static_cast<float>(x)) / std::exp(static_cast<float>(x)), 1.0,
                2e-7 * (1.0 - x));
  }
  EXPECT_EQ(ExpOfNegative(0.0F), 1.0F);
  EXPECT_GT(ExpOfNegative(-1e30F), 0.0F);
  EXPECT_LT(ExpOfNegative(-1e30F), 2e-38F);
}

// Solar illuminance constant: 127.5 klx (IES) to 133.4 klx (newer spectra).
TEST(SpectralBands, HaveTheSolarIlluminance) {
  const XyY sun = WithEightBands([](double) { return 1.0; });
  EXPECT_NEAR(sun.luminance, 132'550.0, 100.0);
  EXPECT_NEAR(sun.luminance, WithAllBands([](double) { return 1.0; }).luminance, 1.0);
  EXPECT_NEAR(sun.x, 0.3235, 0.003);  // Daylight of 5,900 K.
}

TEST(SpectralBands, AreAsGoodAsThirtyEight) {
  double luminance_sum = 0.0, luminance_worst = 0.0, xy_sum = 0.0, xy_worst = 0.0;
  int count = 0;
  for (const double beta : {0.0, 0.03, 0.1, 0.4, 0.9}) {
    const Aerosol aerosol{.beta = beta};
    const auto depth = [&](double wavelength) {
      return MoleculeScattering(wavelength) * 8'000.0 +
             AerosolExtinction(aerosol, wavelength) * aerosol.scale_height_m +
             OzoneAbsorption(wavelength) * 15'000.0;
    };
    for (const double mass : {1.0, 2.0, 5.0, 10.0, 20.0, 30.0}) {
      const auto sun = [&](double wavelength) { return std::exp(-mass * depth(wavelength)); };
      const auto sky = [&](double wavelength) {
        const double molecules = MoleculeScattering(wavelength) * 8'000.0;
        return (1.0 - std::exp(-mass * molecules)) * std::exp(-depth(wavelength));
      };
      for (const auto& [all, eight] : {std::pair{WithAllBands(sun), WithEightBands(sun)},
                                       std::pair{WithAllBands(sky), WithEightBands(sky)}}) {
        const double luminance = std::fabs(eight.luminance / all.luminance - 1.0);
        const double xy = std::hypot(eight.x - all.x, eight.y - all.y);
        luminance_sum += luminance;
        xy_sum += xy;
        luminance_worst = std::max(luminance_worst, luminance);
        xy_worst = std::max(xy_worst, xy);
        ++count;
      }
    }
  }
  EXPECT_LT(luminance_sum / count, 0.005);
  EXPECT_LT(luminance_worst, 0.02);
  EXPECT_LT(xy_sum / count, 0.0025);
  EXPECT_LT(xy_worst, 0.04);
}

TEST(AirMedium, HasPhaseFunctionsThatConserveLight) {
  for (const double g : {0.0, 0.5, 0.76, 0.9}) {
    double molecules = 0.0, aerosol = 0.0, forward = 0.0;
    constexpr int kSteps = 200'000;
    for (int i = 0; i < kSteps; ++i) {
      const double cosine = -1.0 + 2.0 * (i + 0.5) / kSteps;
      const double solid_angle = 2.0 * M_PI * 2.0 / kSteps;
      molecules += MoleculePhase(cosine) * solid_angle;
      aerosol += AerosolPhase(g, cosine) * solid_angle;
      forward += AerosolPhase(g, cosine) * cosine * solid_angle;
    }
    EXPECT_NEAR(molecules, 1.0, 1e-9);
    EXPECT_NEAR(aerosol, 1.0, 1e-6);
    EXPECT_NEAR(forward, g, 1e-6);
  }
}

// Bodhaine et al. 1999, Table 3: vertical optical depth at 550 nm 0.097; ozone 300 DU, 0.03 near
// 600 nm.
TEST(AirMedium, HasTheVerticalDepthsOfTheStandardAtmosphere) {
  EXPECT_NEAR(MoleculeScattering(550.0) * 8'000.0, 0.1, 0.01);
  EXPECT_NEAR(OzoneAbsorption(600.0) * 15'000.0, 0.040, 0.006);
}

TEST(Aerosol, OfATurbidityGrowsFromNothing) {
  EXPECT_EQ(AerosolOfTurbidity(0.9).beta, 0.0);
  EXPECT_NEAR(AerosolOfTurbidity(1.0).beta, 0.0, 3e-4);
  EXPECT_NEAR(AerosolOfTurbidity(2.0).beta, 0.0463, 1e-4);
}

}  // namespace
}  // namespace pleinair::sky
