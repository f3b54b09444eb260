#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "glsl_perez.h"
#include "sky/perez.h"

namespace pleinair::sky {
namespace {

Vec3 RandomDirection(std::mt19937_64& random, double lowest_z) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double z = lowest_z + (1.0 - lowest_z) * unit(random);
  const double azimuth = 2.0 * M_PI * unit(random);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::sin(azimuth), r * std::cos(azimuth), z};
}

glm::vec3 ToGlm(Vec3 v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

TEST(SkyPerezGlsl, EqualsTheCppWithinOneInTenThousand) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> turbidities(1.0, 11.0);
  double worst = 0.0;
  for (int i = 0; i < 20000; ++i) {
    const double turbidity = turbidities(random);
    const Vec3 to_sun = RandomDirection(random, -0.3);
    // A tenth of the directions within 3° of the sun, where digits are lost most easily.
    Vec3 direction = RandomDirection(random, 0.0);
    if (i % 10 == 0 && to_sun.z > 0.1) direction = Normalized(to_sun + direction * 0.05);
    const LinearRgb expected = PerezSky(turbidity, {to_sun}).Radiance({direction});
    const glm::vec3 got = glsl::PerezSkyRadiance(
        glsl::PerezSkyCreate(static_cast<float>(turbidity), ToGlm(to_sun)), ToGlm(direction));
    // Relative to the brightest channel: a channel close to zero has no relative accuracy.
    const double scale = std::max({expected.r, expected.g, expected.b});
    const double error = std::max({std::fabs(got.r - expected.r), std::fabs(got.g - expected.g),
                                   std::fabs(got.b - expected.b)}) /
                         scale;
    worst = std::max(worst, error);
    ASSERT_LT(error, 1e-4) << "turbidity " << turbidity << " sun z " << to_sun.z << " view z "
                           << direction.z;
  }
  RecordProperty("worst_relative_error", std::to_string(worst));
}

TEST(SkyPerezGlsl, IsBlackBelowTheHorizon) {
  const glsl::PerezSky sky = glsl::PerezSkyCreate(2.5f, glm::vec3(0.0f, 0.6f, 0.8f));
  EXPECT_EQ(glsl::PerezSkyRadiance(sky, glm::vec3(0.6f, 0.0f, -0.8f)), glm::vec3(0.0f));
}

}  // namespace
}  // namespace pleinair::sky
