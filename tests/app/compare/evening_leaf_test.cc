// Compares leaves in the light of a low sun with the colors of their full spectra.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

#include "app/compare/ciede2000.h"
#include "base/srgb.h"
#include "compositor/leaf/leaf_color.h"
#include "compositor/leaf/plate.h"
#include "compositor/leaf/prospect.h"
#include "sky/atmosphere/air_medium.h"
#include "sky/atmosphere/spectral_bands.h"

namespace pleinair::app {
namespace {

using compositor::kLightBands;
using compositor::LeafIlluminant;
using compositor::LightSpectrum;

LightSpectrum EveningSun(double air_mass, double beta) {
  const sky::Aerosol aerosol{.beta = beta};
  LightSpectrum sun;
  for (std::size_t i = 0; i < kLightBands; ++i) {
    const double nm = compositor::LightBandNm(i);
    sun[i] = sky::SolarIrradiance(nm) *
             std::exp(-air_mass * (sky::MoleculeScattering(nm) * 8'000.0 +
                                   sky::AerosolExtinction(aerosol, nm) * aerosol.scale_height_m +
                                   sky::OzoneAbsorption(nm) * 15'000.0));
  }
  return sun;
}

/// As a picture shows it.
Lab LabOf(LinearRgb color) {
  return LabFromSrgb8(
      {Srgb8FromLinear(color.r), Srgb8FromLinear(color.g), Srgb8FromLinear(color.b)});
}

struct MeanDifferences {
  double ours = 0.0, paper = 0.0;
};

TEST(EveningLeaf, LooksAsItsSpectrumDoes) {
  std::mt19937 random(31);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  MeanDifferences reflected, transmitted;
  double worst = 0.0;
  constexpr int kLeaves = 200;
  for (int i = 0; i < kLeaves; ++i) {
    const LightSpectrum sun = EveningSun(between(5.0, 15.0), between(0.03, 0.08));
    scene::Leaf leaf;
    leaf.contents = {.chlorophyll_ug_cm2 = between(2.0, 80.0),
                     .carotenoids_ug_cm2 = between(2.0, 20.0),
                     .structure = between(1.2, 2.2)};
    scene::Leaf of_paper = leaf;
    of_paper.model = scene::LeafModel::kPlate;
    LinearRgb light = compositor::ColorOfSpectrum(sun);
    light = light * (0.8 / Luminance(light));
    const auto truth = ColorsOfLeaf(leaf, LeafIlluminant(sun));
    const auto ours = ColorsOfLeaf(leaf, LeafIlluminant::OfLight(light));
    const auto paper = compositor::PlateColors(of_paper);
    const auto add = [&](LinearRgb compositor::LeafColors::*side, MeanDifferences* mean) {
      const Lab exact = LabOf(truth.*side * light);
      const double difference = Ciede2000(exact, LabOf(ours.*side * light));
      mean->ours += difference / kLeaves;
      mean->paper += Ciede2000(exact, LabOf(paper.*side * light)) / kLeaves;
      worst = std::max(worst, difference);
    };
    add(&compositor::LeafColors::reflectance, &reflected);
    add(&compositor::LeafColors::transmittance, &transmitted);
  }
  RecordProperty("reflected", std::to_string(reflected.ours));
  RecordProperty("transmitted", std::to_string(transmitted.ours));
  RecordProperty("worst", std::to_string(worst));
  RecordProperty("paper_reflected", std::to_string(reflected.paper));
  RecordProperty("paper_transmitted", std::to_string(transmitted.paper));
  EXPECT_LT(reflected.ours, 1.0);
  EXPECT_LT(transmitted.ours, 1.0);
  // Three wavelengths are no colors.
  EXPECT_GT(reflected.paper, 5.0);
  EXPECT_GT(transmitted.paper, 9.0);
}

}  // namespace
}  // namespace pleinair::app
