#include "compositor/leaf/leaf_inversion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "compositor/leaf/prospect.h"

namespace pleinair::compositor {
namespace {

MeasuredSpectrum Measured(const scene::LeafContents& contents, int first_nm, int last_nm,
                          int step_nm, double noise, bool transmittance) {
  std::mt19937 random(17);
  std::normal_distribution<double> normal(0.0, 1.0);
  MeasuredSpectrum spectrum;
  for (int nm = first_nm; nm <= last_nm; nm += step_nm) {
    const LeafOptics at = ProspectOptics(LeafBandAt(nm), contents);
    spectrum.wavelength_nm.push_back(nm);
    spectrum.reflectance.push_back(at.reflectance + noise * normal(random));
    if (transmittance) spectrum.transmittance.push_back(at.transmittance + noise * normal(random));
  }
  return spectrum;
}

constexpr scene::LeafContents kGreenLeaf{45.0, 9.0, 1.0, 0.0, 0.012, 0.005, 1.5};
constexpr scene::LeafContents kPaleLeaf{6.0, 4.0, 2.0, 0.3, 0.009, 0.004, 1.3};
constexpr scene::LeafContents kThickLeaf{80.0, 16.0, 0.5, 0.0, 0.03, 0.015, 2.4};

TEST(LeafInversion, FindsTheContentsOfAnExactSpectrum) {
  for (const scene::LeafContents& truth : {kGreenLeaf, kPaleLeaf, kThickLeaf}) {
    const auto fit = FitLeaf(Measured(truth, 400, 2500, 5, 0.0, true), "spectrum");
    ASSERT_TRUE(fit.has_value());
    for (const scene::LeafQuantity& quantity : scene::kLeafQuantities) {
      EXPECT_NEAR(fit->contents.*quantity.value, truth.*quantity.value, 1e-4 * quantity.high)
          << quantity.key;
    }
    EXPECT_LT(fit->rms, 1e-6);
  }
}

TEST(LeafInversion, FindsChlorophyllInANoisySpectrum) {
  for (const scene::LeafContents& truth : {kGreenLeaf, kPaleLeaf, kThickLeaf}) {
    const auto fit = FitLeaf(Measured(truth, 400, 2500, 2, 0.005, true), "spectrum");
    ASSERT_TRUE(fit.has_value());
    EXPECT_NEAR(fit->rms, 0.005, 0.0005);
    for (std::size_t i = 0; i < scene::kLeafQuantities.size(); ++i) {
      const scene::LeafQuantity& quantity = scene::kLeafQuantities[i];
      ASSERT_TRUE(fit->deviations[i].has_value());
      // The deviations describe the errors.
      EXPECT_LT(std::abs(fit->contents.*quantity.value - truth.*quantity.value),
                4.0 * *fit->deviations[i] + 1e-6)
          << quantity.key;
    }
    EXPECT_NEAR(fit->contents.chlorophyll_ug_cm2, truth.chlorophyll_ug_cm2, 0.5);
  }
  const auto green = FitLeaf(Measured(kGreenLeaf, 400, 2500, 2, 0.005, true), "spectrum");
  EXPECT_NEAR(green->contents.chlorophyll_ug_cm2, kGreenLeaf.chlorophyll_ug_cm2, 0.2);
}

TEST(LeafInversion, UsesReflectanceAlone) {
  const auto fit = FitLeaf(Measured(kGreenLeaf, 400, 2500, 5, 0.0, false), "spectrum");
  ASSERT_TRUE(fit.has_value());
  EXPECT_NEAR(fit->contents.chlorophyll_ug_cm2, 45.0, 0.05);
}

TEST(LeafInversion, SaysWhatTheWavelengthsDoNotDetermine) {
  const auto fit = FitLeaf(Measured(kGreenLeaf, 400, 690, 1, 0.002, true), "spectrum");
  ASSERT_TRUE(fit.has_value());
  EXPECT_NEAR(fit->contents.chlorophyll_ug_cm2, 45.0, 1.0);
  EXPECT_FALSE(fit->deviations[4].has_value());  // Water.
  EXPECT_EQ(fit->contents.water_cm, 0.0);
  EXPECT_FALSE(FitLeaf(Measured(kGreenLeaf, 400, 408, 1, 0.0, true), "few").has_value());
}

}  // namespace
}  // namespace pleinair::compositor
