// The skies' shader twins, compiled as C++, against the C++.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "sky/cie_sky.h"
#include "sky/perez.h"
#include "sky/sun/sun_direction.h"
#include "tests/sky/glsl_skies.h"
#include "tests/sky/sky_twin_cases.h"

namespace pleinair::sky {
namespace {

double Difference(LinearRgb expected, const glm::vec3& got) {
  return RelativeDifference(expected, got.r, got.g, got.b);
}

TEST(SkyAnglesGlsl, AreRightToTheLastDigits) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 a = RandomDirection(random, -1.0);
    Vec3 b = RandomDirection(random, -1.0);
    if (i % 3 == 0) b = Normalized(a + b * 1e-3);
    if (i % 3 == 1) b = Normalized(b * 1e-3 - a);
    const double angle = 2.0 * std::atan2(Norm(a - b), Norm(a + b));
    ASSERT_NEAR(glsl::SkyAngleBetween(glsl::ToVec3(a), glsl::ToVec3(b)), angle, 2e-6);
    ASSERT_NEAR(glsl::SkyElevation(glsl::ToVec3(a)), std::asin(a.z), 1e-6);
    const double across = std::fabs(a.x * b.y - a.y * b.x), along = a.x * b.x + a.y * b.y;
    if (std::hypot(across, along) < 0.01) continue;  // At the zenith there is no azimuth.
    ASSERT_NEAR(glsl::SkyAzimuthBetween(glsl::ToVec3(a), glsl::ToVec3(b)),
                std::atan2(across, along), 2e-5);
  }
}

TEST(SkyPerezGlsl, EqualsTheCppWithinOneInTenThousand) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> turbidities(1.0, 11.0);
  for (int i = 0; i < 400; ++i) {
    const double turbidity = static_cast<float>(turbidities(random));
    const Vec3 to_sun = RoundedToFloat(RandomDirection(random, -0.3));
    const PerezSky sky(turbidity, {to_sun});
    const glsl::PerezSky twin =
        glsl::PerezSkyCreate(static_cast<float>(turbidity), glsl::ToVec3(to_sun));
    for (const Vec3& direction : DirectionsAbout(to_sun, 50, random)) {
      ASSERT_LT(Difference(sky.Radiance({direction}),
                           glsl::PerezSkyRadiance(twin, glsl::ToVec3(direction))),
                1e-4)
          << "turbidity " << turbidity << " sun z " << to_sun.z << " view z " << direction.z;
    }
  }
}

TEST(SkyCieGlsl, EqualsTheCppWithinOneInTenThousand) {
  std::mt19937_64 random(12);
  for (int i = 0; i < 300; ++i) {
    const int type = 1 + i % 15;
    const Vec3 to_sun = RoundedToFloat(RandomDirection(random, -0.3));
    const CieSky sky(type, {to_sun});
    const glsl::CieSky twin = glsl::CieSkyCreate(type, glsl::ToVec3(to_sun));
    for (const Vec3& direction : DirectionsAbout(to_sun, 50, random)) {
      const double expected = sky.RelativeLuminance({direction});
      ASSERT_NEAR(glsl::CieSkyRelativeLuminance(twin, glsl::ToVec3(direction)) / expected, 1.0,
                  1e-4)
          << "type " << type << " sun z " << to_sun.z << " view z " << direction.z;
    }
  }
}

TEST(SkyAtmosphereGlsl, EqualsTheCppWithinOneInTenThousand) {
  std::mt19937_64 random(13);
  for (const double turbidity : {1.5, 3.0, 12.0}) {
    const auto tables =
        std::make_shared<const AtmosphereTables>(AerosolOfTurbidity(turbidity), 0.15);
    for (int i = 0; i < 20; ++i) {
      const Vec3 to_sun = RoundedToFloat(RandomDirection(random, -0.3));
      const AtmosphereSky sky(tables, {to_sun}, 1.0);
      glsl::atmosphere_nodes = sky.nodes().data();
      for (const Vec3& direction : DirectionsAbout(to_sun, 200, random)) {
        const LinearRgb expected = RgbFromXyY(XyYFromXyz(sky.Xyz({direction})));
        const glm::vec3 got = glsl::AtmosphereSkyRadiance(
            glsl::ToVec3(to_sun), static_cast<float>(sky.asymmetry()), glsl::ToVec3(direction));
        ASSERT_LT(Difference(expected, got), 1e-4)
            << "turbidity " << turbidity << " sun z " << to_sun.z << " view z " << direction.z;
      }
    }
  }
}

TEST(SkyAtmosphereGlsl, HasTheAirOfTheCppWithinOneInTenThousand) {
  std::mt19937_64 random(14);
  std::uniform_real_distribution<double> logarithms(1.0, 5.0);
  for (const double turbidity : {1.5, 3.0, 12.0}) {
    const AtmosphereTables tables(AerosolOfTurbidity(turbidity), 0.15);
    for (int i = 0; i < 20; ++i) {
      const Vec3 to_sun = RoundedToFloat(RandomDirection(random, -0.05));
      const AerialPerspective air(tables, {to_sun}, 1.0);
      glsl::aerial_nodes = air.nodes().data();
      const glsl::AerialConstants twin = glsl::ToGlsl(air.constants());
      for (int j = 0; j < 100; ++j) {
        const Vec3 direction = RoundedToFloat(RandomDirection(random, -1.0));
        const auto distance = static_cast<float>(std::pow(10.0, logarithms(random)));
        const glm::vec3 there = glsl::ToVec3(direction);
        ASSERT_LT(Difference(air.Inscattered({direction}, Metres(distance)),
                             glsl::AerialInscattered(twin, there, distance)),
                  1e-4)
            << "turbidity " << turbidity << " sun z " << to_sun.z << " view z " << direction.z;
        ASSERT_LT(Difference(air.Transmittance({direction}, Metres(distance)),
                             glsl::AerialTransmittance(twin, there, distance)),
                  1e-4);
      }
    }
  }
}

TEST(SkyCloudsGlsl, EqualTheCppWithinOneInTenThousand) {
  std::mt19937_64 random(15);
  for (int i = 0; i < 300; ++i) {
    const CloudCase c = RandomCloudCase(random, i);
    const Clouds clouds = c.Create();
    const glm::vec3 to_sun = glsl::ToVec3(c.to_sun);
    const glsl::SkyClouds twin = glsl::SkyCloudsCreate(
        static_cast<float>(c.cover), to_sun, glm::vec2(c.clear_sky.g, c.clear_sun.g),
        glm::vec2(clouds.lower().IlluminanceOverZenith(), clouds.upper().IlluminanceOverZenith()));
    const CloudTransmission passed = TransmissionOfClouds(c.cover, Radians(std::asin(c.to_sun.z)));
    ASSERT_NEAR(twin.passed.sun, passed.sun, 1e-5) << c.cover << " sun z " << c.to_sun.z;
    ASSERT_NEAR(twin.passed.global, passed.global, 1e-6) << c.cover;
    for (const Vec3& direction : DirectionsAbout(c.to_sun, 50, random)) {
      const LinearRgb clear = ClearBehindClouds(direction);
      ASSERT_LT(Difference(clouds.Radiance({direction}, clear),
                           glsl::SkyCloudsRadiance(twin, glm::vec3(clear.r, clear.g, clear.b),
                                                   glsl::ToVec3(direction))),
                1e-4)
          << "cover " << c.cover << " sun z " << c.to_sun.z << " view z " << direction.z;
    }
  }
}

TEST(SkyGlsl, IsBlackBelowTheHorizon) {
  const glm::vec3 down(0.6F, 0.0F, -0.8F), to_sun(0.0F, 0.6F, 0.8F);
  EXPECT_EQ(glsl::PerezSkyRadiance(glsl::PerezSkyCreate(2.5F, to_sun), down), glm::vec3(0.0F));
  EXPECT_EQ(glsl::CieSkyRelativeLuminance(glsl::CieSkyCreate(7, to_sun), down), 0.0F);
  EXPECT_EQ(glsl::AtmosphereSkyRadiance(to_sun, 0.76F, down), glm::vec3(0.0F));
}

// The tables' sizes are written in both languages.
TEST(SkyAtmosphereGlsl, KnowsTheSizesOfTheTables) {
  EXPECT_EQ(glsl::kAtmosphereRings, AtmosphereSky::kRings);
  EXPECT_EQ(glsl::kAtmosphereSectors, AtmosphereSky::kSectors);
  EXPECT_EQ(glsl::kAerialRows, AerialPerspective::kRows);
  EXPECT_EQ(glsl::kAerialSectors, AerialPerspective::kSectors);
}

}  // namespace
}  // namespace pleinair::sky
