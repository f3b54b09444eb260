#include "compositor/leaf/plate.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "tests/compositor/leaf/golden_spectra.h"

namespace pleinair::compositor {
namespace {

/// Table 1 of Miao et al. 2016, "simulated".
struct PaperLeaf {
  double chlorophyll, carotenoids;
  std::array<double, 3> reflectance, transmittance;
};
constexpr PaperLeaf kPaperLeaves[] = {
    {31.7, 10.6, {.0437, .1252, .0436}, {.0632, .2875, .0095}},
    {59.2, 7.27, {.0382, .0788, .0435}, {.0159, .1990, .0031}},
    {0.0, 9.10, {.3933, .3041, .0540}, {.6067, .5378, .0808}},
    {11.62, 3.17, {.0940, .2329, .0578}, {.2034, .4464, .0942}},
};

TEST(Plate, ReproducesTheTableOfThePaper) {
  constexpr double kTolerance = 0.0002;
  for (const PaperLeaf& paper : kPaperLeaves) {
    scene::Leaf leaf;
    leaf.model = scene::LeafModel::kPlate;
    leaf.contents.chlorophyll_ug_cm2 = paper.chlorophyll;
    leaf.contents.carotenoids_ug_cm2 = paper.carotenoids;
    const LeafColors colors = PlateColors(leaf);
    EXPECT_NEAR(colors.reflectance.r, paper.reflectance[0], kTolerance);
    EXPECT_NEAR(colors.reflectance.g, paper.reflectance[1], kTolerance);
    EXPECT_NEAR(colors.reflectance.b, paper.reflectance[2], kTolerance);
    EXPECT_NEAR(colors.transmittance.r, paper.transmittance[0], kTolerance);
    EXPECT_NEAR(colors.transmittance.g, paper.transmittance[1], kTolerance);
    EXPECT_NEAR(colors.transmittance.b, paper.transmittance[2], kTolerance);
  }
}

TEST(Plate, HasThePublishedSurfaceTransmittance) {
  EXPECT_NEAR(ConeTransmittance(FromDegrees(90.0), 1.42), 0.920147, 1e-6);
  EXPECT_NEAR(ConeTransmittance(FromDegrees(0.0), 1.42), 0.969879, 1e-6);
  for (const GoldenTransmittance& golden : kConeOf40) {
    EXPECT_NEAR(ConeTransmittance(FromDegrees(40.0), golden.refractive_index), golden.transmittance,
                1e-9);
  }
  // The cone's limit is the ray along the normal.
  EXPECT_NEAR(ConeTransmittance(FromDegrees(0.5), 1.42), ConeTransmittance(FromDegrees(0.0), 1.42),
              1e-5);
}

TEST(Plate, LayersTransmitWhatTheExponentialIntegralSays) {
  for (int i = 0; i < 265; ++i) {
    const double k = 1e-6 * std::pow(1.07, i);  // Up to 57.
    const double exact = (1.0 - k) * std::exp(-k) - k * k * std::expint(-k);
    ASSERT_NEAR(LayerTransmittance(k), exact, 1e-8) << k;
  }
  EXPECT_EQ(LayerTransmittance(0.0), 1.0);
  EXPECT_NEAR(LayerTransmittance(1e-12), 1.0, 1e-11);
  EXPECT_GE(LayerTransmittance(50.0), 0.0);
  EXPECT_LT(LayerTransmittance(50.0), 1e-20);
  EXPECT_EQ(LayerTransmittance(1e6), 0.0);
  // Where the formula changes.
  EXPECT_NEAR(LayerTransmittance(1.0), LayerTransmittance(std::nextafter(1.0, 2.0)), 1e-8);
}

TEST(Plate, NeitherGainsNorLosesLightByItself) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const PlateSurface surface =
        PlateSurfaceOf(FromDegrees(90.0 * any(random)), 1.1 + 0.9 * any(random));
    const LeafOptics clear = PlateOptics(surface, 1.0);
    ASSERT_NEAR(clear.reflectance + clear.transmittance, 1.0, 1e-12);
    const LeafOptics tinted = PlateOptics(surface, any(random));
    ASSERT_LE(tinted.reflectance + tinted.transmittance, 1.0);
    ASSERT_GE(tinted.transmittance, 0.0);
  }
}

}  // namespace
}  // namespace pleinair::compositor
