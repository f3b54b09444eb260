#include "compositor/leaf/prospect.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "tests/compositor/leaf/golden_spectra.h"

namespace pleinair::compositor {
namespace {

scene::LeafContents RandomContents(std::mt19937* random) {
  scene::LeafContents contents;
  for (const scene::LeafQuantity& quantity : scene::kLeafQuantities) {
    contents.*quantity.value =
        std::uniform_real_distribution<double>(quantity.low, quantity.high)(*random);
  }
  return contents;
}

TEST(Prospect, HasThePublishedCoefficients) {
  std::array<double, kLeafConstituents> sums{};
  double n = 0.0;
  for (int nm = kFirstLeafNm; nm <= kLastLeafNm; ++nm) {
    const LeafBand& band = LeafBandAt(nm);
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += band.absorption[i];
    n += std::sqrt(band.inner.n2);
  }
  EXPECT_NEAR(n, 2888.9453, 1e-6);
  EXPECT_NEAR(sums[0], 10.553855, 1e-6);
  EXPECT_NEAR(sums[1], 17.531648, 1e-6);
  EXPECT_NEAR(sums[2], 11.350247, 1e-6);
  EXPECT_NEAR(sums[3], 112.636887, 1e-6);
  EXPECT_NEAR(sums[4], 37893.985236, 1e-5);
  EXPECT_NEAR(sums[5], 20056.842, 1e-5);
}

TEST(Prospect, AgreesWithThePublishedSpectrum) {
  const scene::LeafContents contents{.chlorophyll_ug_cm2 = 30.0,
                                     .carotenoids_ug_cm2 = 10.0,
                                     .anthocyanins_ug_cm2 = 1.0,
                                     .water_cm = 0.015,
                                     .dry_g_cm2 = 0.009,
                                     .structure = 1.2};
  std::vector<LeafOptics> spectrum(kLeafBands);
  ProspectSpectrum(contents, kFirstLeafNm, spectrum);
  for (const GoldenOptics& golden : kFeretSpectrum) {
    const LeafOptics& at = spectrum[static_cast<std::size_t>(golden.wavelength_nm - kFirstLeafNm)];
    EXPECT_NEAR(at.reflectance, golden.reflectance, 1e-7) << golden.wavelength_nm;
    EXPECT_NEAR(at.transmittance, golden.transmittance, 1e-7) << golden.wavelength_nm;
  }
}

TEST(Prospect, AgreesWithAnotherProgramWithinAndAtTheEndsOfTheRange) {
  for (const GoldenLeaf& leaf : kNumpyLeaves) {
    for (const GoldenOptics& golden : leaf.optics) {
      const LeafOptics at = ProspectOptics(LeafBandAt(golden.wavelength_nm), leaf.contents);
      EXPECT_NEAR(at.reflectance, golden.reflectance, 1e-7) << golden.wavelength_nm;
      EXPECT_NEAR(at.transmittance, golden.transmittance, 1e-7) << golden.wavelength_nm;
    }
  }
}

TEST(Prospect, NeverGainsLightAndLosesMoreWithMoreOfAnything) {
  std::mt19937 random(11);
  for (int i = 0; i < 20; ++i) {
    const scene::LeafContents contents = RandomContents(&random);
    for (int nm = kFirstLeafNm; nm <= kLastLeafNm; nm += 3) {
      const LeafOptics at = ProspectOptics(LeafBandAt(nm), contents);
      ASSERT_GE(at.reflectance, 0.0);
      ASSERT_GE(at.transmittance, 0.0);
      ASSERT_LE(at.reflectance + at.transmittance, 1.0);
    }
    for (const scene::LeafQuantity& quantity : scene::kLeafQuantities) {
      if (quantity.value == &scene::LeafContents::structure) continue;
      scene::LeafContents more = contents;
      more.*quantity.value += 0.1 * quantity.high;
      for (int nm = kFirstLeafNm; nm <= kLastLeafNm; nm += 7) {
        const LeafOptics before = ProspectOptics(LeafBandAt(nm), contents);
        const LeafOptics after = ProspectOptics(LeafBandAt(nm), more);
        ASSERT_LE(after.reflectance, before.reflectance + 1e-8) << quantity.key << ' ' << nm;
        ASSERT_LE(after.transmittance, before.transmittance + 1e-8) << quantity.key << ' ' << nm;
      }
    }
  }
}

TEST(Prospect, ClearLeavesLoseNothing) {
  for (int i = 0; i <= 12; ++i) {
    const double structure = 1.0 + 0.25 * i;
    const LeafOptics clear = StackOptics(LeafBandAt(550), 0.0, structure);
    EXPECT_NEAR(clear.reflectance + clear.transmittance, 1.0, 1e-12);
    // Hardly any absorption is hardly another result.
    const LeafOptics nearly = StackOptics(LeafBandAt(550), 1e-12, structure);
    EXPECT_NEAR(nearly.transmittance, clear.transmittance, 1e-6);
    const LeafOptics black = StackOptics(LeafBandAt(550), 1e4, structure);
    EXPECT_TRUE(std::isfinite(black.reflectance));
    EXPECT_EQ(black.transmittance, 0.0);
  }
}

TEST(Prospect, SpectraAreThoseOfSingleWavelengths) {
  std::mt19937 random(23);
  std::vector<scene::LeafContents> leaves = {{}, {.structure = 1.0}, {.structure = 4.0}};
  for (int i = 0; i < 20; ++i) leaves.push_back(RandomContents(&random));
  for (const scene::LeafContents& contents : leaves) {
    for (const int count : {1, 3, 7, 8, 701}) {
      const int first_nm = kLastLeafNm + 1 - count;
      std::vector<LeafOptics> spectrum(static_cast<std::size_t>(count));
      ProspectSpectrum(contents, first_nm, spectrum);
      for (int i = 0; i < count; ++i) {
        const LeafOptics single = ProspectOptics(LeafBandAt(first_nm + i), contents);
        const LeafOptics& at = spectrum[static_cast<std::size_t>(i)];
        ASSERT_NEAR(at.reflectance, single.reflectance, 1e-9) << first_nm + i;
        ASSERT_NEAR(at.transmittance, single.transmittance, 1e-9) << first_nm + i;
      }
    }
  }
}

TEST(Prospect, InterpolatesBetweenNanometres) {
  const scene::LeafContents contents{.chlorophyll_ug_cm2 = 40.0, .dry_g_cm2 = 0.005};
  const double low = ProspectOptics(LeafBandAt(700), contents).reflectance;
  const double high = ProspectOptics(LeafBandAt(701), contents).reflectance;
  EXPECT_NEAR(ProspectOptics(InterpolatedLeafBand(700.5), contents).reflectance, (low + high) / 2.0,
              3e-4);
  EXPECT_NEAR(ProspectOptics(InterpolatedLeafBand(701.0), contents).reflectance, high, 1e-12);
}

}  // namespace
}  // namespace pleinair::compositor
