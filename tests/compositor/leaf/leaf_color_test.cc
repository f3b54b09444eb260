#include "compositor/leaf/leaf_color.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>

#include "compositor/leaf/prospect.h"
#include "sky/atmosphere/air_medium.h"
#include "sky/atmosphere/spectral_bands.h"
#include "sky/cie_observer.h"
#include "sky/color.h"

namespace pleinair::compositor {
namespace {

scene::Leaf RandomLeaf(std::mt19937* random) {
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(*random);
  };
  scene::Leaf leaf;
  leaf.contents = {.chlorophyll_ug_cm2 = between(2.0, 80.0),
                   .carotenoids_ug_cm2 = between(2.0, 20.0),
                   .anthocyanins_ug_cm2 = between(0.0, 10.0),
                   .brown = between(0.0, 0.5),
                   .water_cm = 0.012,
                   .dry_g_cm2 = 0.005,
                   .structure = between(1.2, 2.2)};
  return leaf;
}

double LargestDifference(LinearRgb a, LinearRgb b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// A value between tabulated ones by Catmull and Rom's cubic.
template <typename ValueAt>
double CubicBetween(const ValueAt& at, int i, double t) {
  const double p0 = at(i - 1), p1 = at(i), p2 = at(i + 1), p3 = at(i + 2);
  return p1 + 0.5 * t *
                  (p2 - p0 +
                   t * (2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3 + t * (3.0 * (p1 - p2) + p3 - p0)));
}

/// The leaf's color under D65, integrated at every nanometre.
LeafColors ColorsAtEveryNanometre(const scene::Leaf& leaf) {
  Vec3 white, reflected, transmitted;
  for (int nm = 400; nm < 750; ++nm) {
    const int i = (nm - 400) / 10;
    const double t = (nm - 400) % 10 / 10.0;
    const auto observed = [&](double sky::ObserverBand::*channel) {
      return CubicBetween(
          [&](int k) {
            const int band = std::min<int>(k + kFirstLightBand, sky::kCie1931.size() - 1);
            return sky::kCie1931[static_cast<std::size_t>(band)].*channel;
          },
          i, t);
    };
    const LightSpectrum& d65 = D65Spectrum();
    const double light = std::lerp(d65[static_cast<std::size_t>(i)],
                                   d65[std::min<std::size_t>(i + 1, kLightBands - 1)], t);
    const Vec3 seen = Vec3{observed(&sky::ObserverBand::x), observed(&sky::ObserverBand::y),
                           observed(&sky::ObserverBand::z)} *
                      light;
    const LeafOptics optics = ProspectOptics(LeafBandAt(nm), leaf.contents);
    white = white + seen;
    reflected = reflected + seen * optics.reflectance;
    transmitted = transmitted + seen * optics.transmittance;
  }
  const auto rgb = [](Vec3 xyz) { return sky::RgbFromXyz(xyz.x, xyz.y, xyz.z); };
  return {rgb(reflected) / rgb(white), rgb(transmitted) / rgb(white)};
}

TEST(LeafColor, AgreesWithAnIntegrationAtEveryNanometre) {
  std::mt19937 random(3);
  double worst = 0.0;
  for (int i = 0; i < 200; ++i) {
    const scene::Leaf leaf = RandomLeaf(&random);
    const LeafColors colors = ColorsOfLeaf(leaf, LeafIlluminant::D65());
    const LeafColors fine = ColorsAtEveryNanometre(leaf);
    worst = std::max({worst, LargestDifference(colors.reflectance, fine.reflectance),
                      LargestDifference(colors.transmittance, fine.transmittance)});
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LT(worst, 0.001);
}

TEST(LeafColor, IsWhiteForAWhiteDiffuser) {
  LightSpectrum white;
  white.fill(1.0);
  for (const LinearRgb light : {LinearRgb{1, 1, 1}, {5.0, 2.0, 0.4}, {0.6, 0.8, 1.6}}) {
    EXPECT_LT(LargestDifference(LeafIlluminant::OfLight(light).Ratio(white), {1, 1, 1}), 1e-12);
  }
  const sky::XyY d65 = sky::XyYFromRgb(ColorOfSpectrum(D65Spectrum()));
  EXPECT_NEAR(d65.x, 0.3127, 0.0005);
  EXPECT_NEAR(d65.y, 0.3290, 0.0005);
}

TEST(LeafColor, MakesDaylightOfTheColorThatIsAskedFor) {
  for (const LinearRgb light : {LinearRgb{1, 1, 1},
                                {1.2, 1.0, 0.7},
                                {5.0, 2.0, 0.4},
                                {1.0, 0.3, 0.02},
                                {0.5, 0.8, 1.6},
                                {0.3, 0.6, 2.0}}) {
    const LinearRgb made = ColorOfSpectrum(DaylightSpectrum(light));
    EXPECT_LT(LargestDifference(made * (1.0 / Luminance(made)), light * (1.0 / Luminance(light))),
              3e-4)
        << light.r << ' ' << light.g << ' ' << light.b;
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(DaylightSpectrum({0, 0, 0}), D65Spectrum());
  EXPECT_EQ(DaylightSpectrum({1.0, nan, 1.0}), D65Spectrum());
  for (const double value : DaylightSpectrum({1.0, -3.0, 0.0})) {
    EXPECT_TRUE(std::isfinite(value) && value >= 0.0);
  }
}

// The light of the sun passes 1 to 20 air masses of clean and hazy air with ozone. Its spectra by
// the atmosphere model are compared with those made from their colors alone.
TEST(LeafColor, IsThatUnderTheAtmospheresSun) {
  std::mt19937 random(9);
  double worst = 0.0;
  for (const double beta : {0.0, 0.05, 0.2}) {
    for (const double air_mass : {1.0, 2.0, 5.0, 10.0, 20.0}) {
      const sky::Aerosol aerosol{.beta = beta};
      LightSpectrum sun;
      for (std::size_t i = 0; i < kLightBands; ++i) {
        const double nm = LightBandNm(i);
        const double depth = sky::MoleculeScattering(nm) * 8'000.0 +
                             sky::AerosolExtinction(aerosol, nm) * aerosol.scale_height_m +
                             sky::OzoneAbsorption(nm) * 15'000.0;
        sun[i] = sky::SolarIrradiance(nm) * std::exp(-depth * air_mass);
      }
      const LinearRgb color = ColorOfSpectrum(sun) * (1.0 / ColorOfSpectrum(sun).r);
      // A channel of a hundredth carries no visible color.
      if (color.b < 0.02 || color.g < 0.02) continue;
      const LeafIlluminant exact(sun), made = LeafIlluminant::OfLight(color);
      for (int i = 0; i < 20; ++i) {
        const scene::Leaf leaf = RandomLeaf(&random);
        const LeafColors a = ColorsOfLeaf(leaf, exact), b = ColorsOfLeaf(leaf, made);
        // What is seen: the ratios times the light's color.
        worst = std::max({worst, LargestDifference(a.reflectance * color, b.reflectance * color),
                          LargestDifference(a.transmittance * color, b.transmittance * color)});
      }
    }
  }
  RecordProperty("worst", std::to_string(worst));
  EXPECT_LT(worst, 0.01);
}

TEST(LeafColor, OfThePlateIgnoresTheLight) {
  scene::Leaf leaf;
  leaf.model = scene::LeafModel::kPlate;
  leaf.contents.chlorophyll_ug_cm2 = 30.0;
  const LeafColors noon = ColorsOfLeaf(leaf, LeafIlluminant::D65());
  const LeafColors evening = ColorsOfLeaf(leaf, LeafIlluminant::OfLight({5.0, 2.0, 0.4}));
  EXPECT_EQ(noon.reflectance, evening.reflectance);
  // Half as thick with twice the contents is the same leaf.
  scene::Leaf twice = leaf;
  twice.contents.chlorophyll_ug_cm2 *= 2.0;
  EXPECT_LT(LargestDifference(ColorsOfLeaf(twice, LeafIlluminant::D65(), 0.5).transmittance,
                              noon.transmittance),
            1e-12);
}

}  // namespace
}  // namespace pleinair::compositor
