#include "sky/clouds/cloud_slab.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>

#include "sky/clouds/slab_doubling.h"
#include "sky/gauss_rule.h"

namespace pleinair::clouds {
namespace {

// Isotropic scattering without absorption, τ = 1 (Chandrasekhar 1950, §§ 59–61).
TEST(SlabDoubling, HasTheReflectancesOfIsotropicScattering) {
  const SlabFluxes slab = DoubleSlab({0.0, 1.0}, 1.0, 1, {1.0}).front();
  EXPECT_NEAR(slab.diffuse_reflected, 0.4466, 5e-5);
  EXPECT_NEAR(slab.direct[0].reflected, 0.3413, 5e-5);
}

// Henyey–Greenstein with g = 0.85, no absorption: τ, R at μ₀ = 1 and 0.5, S.
TEST(SlabDoubling, HasTheReflectancesOfCloudDroplets) {
  constexpr double kKnown[][4] = {{0.5, 0.0199, 0.0871, 0.0792}, {1, 0.0423, 0.1649, 0.1344},
                                  {2, 0.0910, 0.2802, 0.2194},   {4, 0.1909, 0.4161, 0.3404},
                                  {8, 0.3585, 0.5582, 0.4925},   {16, 0.557, 0.698, 0.652},
                                  {32, 0.728, 0.814, 0.786}};
  const auto slabs = DoubleSlab({0.85, 1.0}, 0.5, 7, {1.0, 0.5});
  for (std::size_t i = 0; i < slabs.size(); ++i) {
    const double bound = kKnown[i][0] < 16.0 ? 2e-4 : 7e-4;  // The last ones have three digits.
    EXPECT_NEAR(slabs[i].direct[0].reflected, kKnown[i][1], bound) << kKnown[i][0];
    EXPECT_NEAR(slabs[i].direct[1].reflected, kKnown[i][2], bound) << kKnown[i][0];
    EXPECT_NEAR(slabs[i].diffuse_reflected, kKnown[i][3], bound) << kKnown[i][0];
  }
}

// Thick layers: 1/(1 − S) grows by 3 (1 − g)/4 a unit of depth (van de Hulst 1980, § 5.3). With
// isotropic scattering 1/(1 − S) = 3/4 (τ + 2 · 0.7104).
TEST(SlabDoubling, ApproachesTheLawOfThickLayers) {
  for (const double g : {0.0, 0.77, 0.85}) {
    const auto slabs = DoubleSlab({g, 1.0}, 128.0, 2, {1.0});
    const double growth = 1.0 / slabs[1].diffuse_transmitted - 1.0 / slabs[0].diffuse_transmitted;
    EXPECT_NEAR(growth / 128.0 / (0.75 * (1.0 - g)), 1.0, 1e-4) << g;
  }
  const auto isotropic = DoubleSlab({0.0, 1.0}, 64.0, 1, {1.0}).front();
  EXPECT_NEAR(1.0 / isotropic.diffuse_transmitted, 0.75 * (64.0 + 2.0 * 0.7104), 0.01);
}

TEST(SlabDoubling, LosesNothingWithoutAbsorption) {
  for (const double g : {-0.4, 0.0, 0.5, 0.85, 0.95}) {
    for (const SlabFluxes& slab : DoubleSlab({g, 1.0}, 0.01, 16, {0.05, 0.3, 1.0})) {
      EXPECT_NEAR(slab.diffuse_reflected + slab.diffuse_transmitted, 1.0, 1e-8);
      for (const SlabFluxes::Direct& direct : slab.direct) {
        EXPECT_NEAR(direct.reflected + direct.transmitted, 1.0, 1e-8);
      }
    }
  }
}

TEST(SlabDoubling, LosesMoreTheMoreIsAbsorbed) {
  double last = 1.0;
  for (const double albedo : {0.9999, 0.999, 0.99, 0.9}) {
    const auto slab = DoubleSlab({0.85, albedo}, 8.0, 1, {0.5}).front();
    const double kept = slab.direct[0].reflected + slab.direct[0].transmitted;
    EXPECT_LT(kept, last);
    EXPECT_GT(slab.direct[0].transmitted, 0.0);
    last = kept;
  }
}

TEST(GaussRule, IntegratesPolynomialsExactly) {
  const sky::GaussRule rule = sky::GaussOnUnitInterval(24);
  for (int power = 0; power < 48; ++power) {
    double sum = 0.0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      sum += rule.weights[i] * std::pow(rule.nodes[i], power);
    }
    EXPECT_NEAR(sum, 1.0 / (power + 1.0), 1e-13) << power;
  }
}

TEST(SlabTable, InterpolatesBetweenDoubledSlabs) {
  const std::vector<double> cosines = {0.1, 0.13, 0.2, 0.27, 0.35, 0.5, 0.61, 0.77, 0.9, 0.97};
  for (const auto* table : {&SlabTable::Water(), &SlabTable::Ice()}) {
    const double g = table == &SlabTable::Water() ? kWaterAsymmetry : kIceAsymmetry;
    for (const double first : {0.017, 0.021, 0.0251}) {
      double depth = first;
      for (const SlabFluxes& slab : DoubleSlab({g, 1.0}, first, 14, cosines)) {
        for (std::size_t i = 0; i < cosines.size(); ++i) {
          EXPECT_NEAR(table->Reflected(depth, cosines[i]), slab.direct[i].reflected, 2.5e-4)
              << depth << " " << cosines[i];
        }
        EXPECT_NEAR(table->DiffuseReflected(depth), slab.diffuse_reflected, 2e-5) << depth;
        depth *= 2.0;
      }
    }
  }
}

TEST(SlabTable, IsMonotoneInDepth) {
  const SlabTable& table = SlabTable::Water();
  EXPECT_EQ(table.Reflected(0.0, 0.7), 0.0);
  for (const double cosine : {0.1, 0.3, 0.5, 0.8, 1.0}) {
    double last = 0.0, last_diffuse = 0.0;
    for (int step = 0; step < 280; ++step) {
      const double depth = 1e-3 * std::pow(1.05, step);  // To 816.
      const double now = table.Reflected(depth, cosine);
      const double diffuse = table.DiffuseReflected(depth);
      ASSERT_GT(now, last) << depth;
      ASSERT_GT(diffuse, last_diffuse) << depth;
      ASSERT_LE(now + Unscattered(depth, cosine), 1.0 + 1e-6) << depth;
      last = now;
      last_diffuse = diffuse;
    }
    EXPECT_LT(last, 1.0);
  }
}

TEST(SlabTable, IsNearDeltaEddington) {
  const SlabTable& table = SlabTable::Water();
  for (const double depth : {0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0}) {
    EXPECT_NEAR(DeltaEddingtonReflected(0.85, depth, 1.0), table.Reflected(depth, 1.0), 0.0065);
    EXPECT_NEAR(DeltaEddingtonReflected(0.85, depth, 0.5), table.Reflected(depth, 0.5), 0.031);
  }
}

TEST(Unscattered, FollowsBeerAndLambert) {
  EXPECT_NEAR(Unscattered(2.0, 0.5), 0.018316, 2e-6);
  EXPECT_EQ(Unscattered(0.0, 0.0), 1.0);
  EXPECT_EQ(Unscattered(1.0, 0.0), 0.0);
}

// Light between snow and a layer of τ = 16 doubles what arrives.
TEST(IlluminanceBelow, CountsTheLightBetweenGroundAndCloud) {
  const LightAbove light{80'000.0, 0.7, 15'000.0};
  const SlabTable& table = SlabTable::Water();
  const double black = IlluminanceBelow(table, 16.0, light, 0.0);
  EXPECT_NEAR(black,
              80'000.0 * (1.0 - table.Reflected(16.0, 0.7)) +
                  15'000.0 * (1.0 - table.DiffuseReflected(16.0)),
              1e-6);
  EXPECT_NEAR(IlluminanceBelow(table, 16.0, light, 0.8) / black, 1.0 / (1.0 - 0.8 * 0.652), 2e-3);
  EXPECT_NEAR(IlluminanceBelow(table, 0.0, light, 0.8), 95'000.0, 1e-6);
}

}  // namespace
}  // namespace pleinair::clouds
