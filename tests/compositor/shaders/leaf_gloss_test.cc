// Tests the shader code of the gloss of leaves, compiled as C++.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gl/glsl_as_cpp.h"

namespace leaf_glsl {
using namespace glm;  // NOLINT(google-build-using-namespace): as GLSL has it.
#include "compositor/shaders/leaf_gloss.glsl"
}  // namespace leaf_glsl

namespace pleinair::compositor {
namespace {

struct LobeSum {
  double lobe = 0.0;      ///< Reflectance of the lobe for one direction.
  double admitted = 0.0;  ///< Mean of LeafAdmits(), weighted by the cosine.
};

/// Integrates over facets, which the distribution weights evenly: tan²θ = −γ² ln(1 − u).
LobeSum IntegrateLobe(double cos_v, double gamma, double gloss) {
  constexpr int kSteps = 200;
  const double sin_v = std::sqrt(1.0 - cos_v * cos_v);
  LobeSum sum;
  for (int i = 0; i < kSteps; ++i) {
    const double u = (i + 0.5) / kSteps;
    const double cos_h = 1.0 / std::sqrt(1.0 - gamma * gamma * std::log1p(-u));
    const double sin_h = std::sqrt(1.0 - cos_h * cos_h);
    for (int j = 0; j < kSteps; ++j) {
      const double phi = 2.0 * std::numbers::pi * (j + 0.5) / kSteps;
      const double cos_vh = sin_v * sin_h * std::cos(phi) + cos_v * cos_h;
      const double cos_i = 2.0 * cos_vh * cos_h - cos_v;
      if (cos_vh <= 0.0 || cos_i <= 0.0) continue;
      const auto h = static_cast<float>(cos_h), vh = static_cast<float>(cos_vh);
      const auto g = static_cast<float>(gamma);
      const double f =
          leaf_glsl::LeafLobe(static_cast<float>(cos_i), static_cast<float>(cos_v), h, vh, g);
      // Solid angle of the light's directions is 4 cos_vh times that of the facets.
      const double facets = leaf_glsl::DistributionLeaf(h, g) * cos_h;
      if (facets > 0.0) sum.lobe += gloss * f * cos_i * 4.0 * cos_vh / facets;
    }
    // Cosine-weighted directions.
    sum.admitted += leaf_glsl::LeafAdmits(static_cast<float>(std::sqrt(u)),
                                          static_cast<float>(gamma), static_cast<float>(gloss));
  }
  sum.lobe /= kSteps * kSteps;
  sum.admitted /= kSteps;
  return sum;
}

TEST(LeafGloss, FacetsCoverTheSurfaceOnce) {
  for (const double gamma : {0.05, 0.1, 0.2, 0.35, 0.6, 0.8}) {
    // Fine steps where the distribution is.
    constexpr int kSteps = 200'000;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double theta = std::numbers::pi / 2 * (i + 0.5) / kSteps;
      const double c2 = std::cos(theta) * std::cos(theta);
      sum += leaf_glsl::DistributionLeaf(static_cast<float>(std::sqrt(c2)),
                                         static_cast<float>(gamma)) *
             std::cos(theta) * std::sin(theta);
    }
    EXPECT_NEAR(sum * 2.0 * std::numbers::pi * (std::numbers::pi / 2) / kSteps, 1.0, 1e-3) << gamma;
  }
}

TEST(LeafGloss, TheTableHoldsItsIntegral) {
  for (const double gamma : {0.05, 0.15, 0.35, 0.6, 1.0}) {
    for (const double cosine : {0.1, 0.3, 0.6, 1.0}) {
      EXPECT_NEAR(leaf_glsl::LeafReflectance(static_cast<float>(cosine), static_cast<float>(gamma)),
                  IntegrateLobe(cosine, gamma, 1.0).lobe, 0.005)
          << gamma << ' ' << cosine;
    }
  }
}

TEST(LeafGloss, WhiteLeavesKeepTheirLight) {
  // A leaf without absorption, whatever share it transmits: inside, reflectance and transmittance
  // sum to 1 of what the surface admits.
  for (const double gloss : {0.0, 0.5, 1.0}) {
    for (const double gamma : {0.05, 0.08, 0.12, 0.2, 0.35, 0.6, 0.75, 1.0}) {
      const double mean =
          leaf_glsl::LeafAdmitsMean(static_cast<float>(gamma), static_cast<float>(gloss));
      for (const double cosine : {0.02, 0.05, 0.12, 0.2, 0.3, 0.5, 0.8, 1.0}) {
        const LobeSum sum = IntegrateLobe(cosine, gamma, gloss);
        const double leaves = leaf_glsl::LeafAdmits(
            static_cast<float>(cosine), static_cast<float>(gamma), static_cast<float>(gloss));
        const double kept = sum.lobe + leaves * sum.admitted / mean;
        EXPECT_GE(kept, 0.995) << gloss << ' ' << gamma << ' ' << cosine;
        EXPECT_LE(kept, 1.001) << gloss << ' ' << gamma << ' ' << cosine;
      }
    }
  }
}

TEST(LeafGloss, IsReciprocal) {
  for (const float a : {0.1F, 0.5F, 0.9F}) {
    for (const float b : {0.2F, 0.7F}) {
      EXPECT_NEAR(leaf_glsl::LeafLobe(a, b, 0.95F, 0.6F, 0.35F),
                  leaf_glsl::LeafLobe(b, a, 0.95F, 0.6F, 0.35F), 1e-6F);
    }
  }
  // Fresnel at the normal: ((n − 1) / (n + 1))²; at grazing incidence all.
  EXPECT_NEAR(leaf_glsl::LeafFresnel(1.0F), 0.0337, 1e-4);
  EXPECT_NEAR(leaf_glsl::LeafFresnel(0.0F), 1.0, 1e-5);
}

}  // namespace
}  // namespace pleinair::compositor
