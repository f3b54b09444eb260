// Tests the shader code of glossy reflection, compiled as C++.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/vector.h"
#include "gl/glsl_as_cpp.h"

namespace glsl {
using namespace glm;  // NOLINT(google-build-using-namespace): as GLSL has it.
#include "compositor/shaders/ggx.glsl"
#include "compositor/shaders/sheen.glsl"
}  // namespace glsl

namespace pleinair::compositor {
namespace {

constexpr int kSteps = 400;

/// Integral of a function of direction over the hemisphere around +z.
template <typename Function>
double OverHemisphere(const Function& function) {
  double sum = 0.0;
  for (int row = 0; row < kSteps; ++row) {
    const double polar = (row + 0.5) / kSteps * std::numbers::pi / 2;
    for (int column = 0; column < kSteps; ++column) {
      const double azimuth = (column + 0.5) / kSteps * 2 * std::numbers::pi;
      sum += std::sin(polar) * function(Vec3{std::sin(polar) * std::cos(azimuth),
                                             std::sin(polar) * std::sin(azimuth), std::cos(polar)});
    }
  }
  return sum * std::numbers::pi * std::numbers::pi / (kSteps * kSteps);
}

TEST(Ggx, FacetsCoverTheSurfaceOnce) {
  // Walter et al. 2007, Eq. (4): the facets' projected area equals that of the macrosurface.
  for (const float alpha : {0.1F, 0.3F, 1.0F}) {
    EXPECT_NEAR(OverHemisphere([&](Vec3 half) {
                  const auto cosine = static_cast<float>(half.z);
                  return cosine * glsl::DistributionGgx(cosine, alpha);
                }),
                1.0, 2e-3)
        << alpha;
  }
}

TEST(Ggx, TheEnvironmentsScaleIsTheIntegralOfTheReflection) {
  for (const float roughness : {0.3F, 0.4F, 0.5F, 0.7F, 1.0F}) {
    for (const double n_dot_v : {0.2, 0.3, 0.6, 1.0}) {
      const Vec3 view{std::sqrt(1 - n_dot_v * n_dot_v), 0.0, n_dot_v};
      const float alpha = roughness * roughness;
      for (const float f0 : {0.04F, 1.0F}) {
        const double reflected = OverHemisphere([&](Vec3 light) {
          const Vec3 half = Normalized(light + view);
          const auto fresnel =
              glsl::FresnelSchlick(static_cast<float>(Dot(view, half)), glm::vec3(f0)).x;
          return light.z * fresnel * glsl::DistributionGgx(static_cast<float>(half.z), alpha) *
                 glsl::VisibilitySmith(static_cast<float>(n_dot_v), static_cast<float>(light.z),
                                       alpha);
        });
        const double fitted =
            glsl::EnvironmentBrdf(glm::vec3(f0), roughness, static_cast<float>(n_dot_v)).x;
        EXPECT_NEAR(fitted, reflected, 0.01 + 0.02 * reflected)
            << roughness << " " << n_dot_v << " " << f0;
      }
    }
  }
}

TEST(Sheen, ItsReflectanceIsTheIntegralOfItsReflection) {
  for (const float roughness : {0.2F, 0.3F, 0.5F, 1.0F}) {
    for (const double n_dot_v : {0.2, 0.5, 1.0}) {
      const Vec3 view{std::sqrt(1 - n_dot_v * n_dot_v), 0.0, n_dot_v};
      const double reflected = OverHemisphere([&](Vec3 light) {
        const Vec3 half = Normalized(light + view);
        return light.z *
               glsl::DistributionCharlie(static_cast<float>(half.z), roughness * roughness) *
               glsl::VisibilityAshikhmin(static_cast<float>(n_dot_v), static_cast<float>(light.z));
      });
      EXPECT_NEAR(glsl::SheenReflectance(roughness, static_cast<float>(n_dot_v)), reflected,
                  0.01 + 0.05 * reflected)
          << roughness << " " << n_dot_v;
    }
  }
}

}  // namespace
}  // namespace pleinair::compositor
