#include "sky/atmosphere/atmosphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include "sky/atmosphere/scattering_layers.h"
#include "sky/dome.h"
#include "sky/sky_model.h"
#include "sky/standard_illuminance.h"
#include "tests/sky/reference/sky_comparison.h"

namespace pleinair::sky {
namespace {

Direction<World> Towards(double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * kRadiansPerDegree;
  const double elevation = elevation_deg * kRadiansPerDegree;
  return {{std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
           std::sin(elevation)}};
}

std::shared_ptr<const AtmosphereTables> TablesOf(double turbidity) {
  return std::make_shared<const AtmosphereTables>(AerosolOfTurbidity(turbidity), 0.15);
}

constexpr double kSunAzimuth = 217.0;

double LuminanceAt(const AtmosphereSky& sky, double azimuth_from_sun, double elevation) {
  return sky.Xyz(Towards(kSunAzimuth + azimuth_from_sun, elevation)).y;
}

struct Condition {
  Aerosol aerosol;
  double albedo, sun_elevation_deg;
  int paths;
};

// The path tracer's noise is 2 to 6 % with this number of paths. docs/measurements/sky.md has the
// errors without it.
TEST(AtmosphereSky, AgreesWithAPathTracer) {
  const auto dome = reference::DomeSamples(8, 6);
  const Aerosol moderate{0.03, 1.1, 1200.0, 0.93, 0.78};
  const Aerosol urban{0.12, 1.0, 1500.0, 0.88, 0.7};
  const Aerosol clean{0.005, 1.4, 1000.0, 0.97, 0.65};
  const Aerosol dusty{0.3, 0.5, 2000.0, 0.9, 0.8};
  for (const Condition& c :
       {Condition{moderate, 0.15, 3.5, 70}, Condition{moderate, 0.15, 40.0, 70},
        Condition{urban, 0.3, 20.0, 70}, Condition{clean, 0.05, 8.0, 70},
        Condition{clean, 0.6, 85.0, 70}, Condition{dusty, 0.2, 30.0, 40}}) {
    const AtmosphereSky sky(std::make_shared<const AtmosphereTables>(c.aerosol, c.albedo),
                            Towards(kSunAzimuth, c.sun_elevation_deg), 1.0);
    const auto truth =
        reference::PathTrace(dome, {c.aerosol, c.albedo, c.sun_elevation_deg}, c.paths, 1);
    const auto ours = reference::Evaluate(dome, [&](const reference::Sample& s) {
      return XyYFromXyz(sky.Xyz(Towards(kSunAzimuth + s.azimuth_deg, s.elevation_deg)));
    });
    const auto error = reference::Compare(dome, truth, ours);
    EXPECT_LT(error.rmse, 0.1) << c.aerosol.beta << ", sun " << c.sun_elevation_deg;
    EXPECT_NEAR(error.illuminance, 1.0, 0.05) << c.aerosol.beta << ", sun " << c.sun_elevation_deg;
    EXPECT_LT(error.chromaticity, 0.04) << c.aerosol.beta << ", sun " << c.sun_elevation_deg;
  }
}

TEST(AtmosphereSky, IsPositiveAndFiniteAtAnyHour) {
  for (const double turbidity : {1.0, 1.5, 4.0, 20.0, 30.0}) {
    const auto tables = TablesOf(turbidity);
    for (const double sun :
         {-90.0, -40.0, -17.0, -6.0, -3.3, -0.2, 0.0, 0.7, 6.0, 31.0, 89.9, 90.0}) {
      const AtmosphereSky sky(tables, Towards(kSunAzimuth, sun), 1.0);
      for (const AtmosphereSky::Node& node : sky.nodes()) {
        for (int i = 0; i < 3; ++i) {
          ASSERT_TRUE(std::isfinite(node.scattered[i]) && std::isfinite(node.aerosol[i]));
          ASSERT_GT(node.scattered[i], 0.0F) << turbidity << " " << sun;
          ASSERT_GE(node.aerosol[i], 0.0F) << turbidity << " " << sun;
          ASSERT_LT(node.scattered[i], 1e6F);
        }
      }
      EXPECT_EQ(sky.Xyz(Towards(0.0, -0.01)), Vec3{});
    }
  }
}

/// In luminance, and in the color channels relative to the brightest.
double ChangeOfLight(Vec3 a, Vec3 b) {
  const LinearRgb p = RgbInGamut(a), q = RgbInGamut(b);
  const double color =
      std::max({std::fabs(p.r - q.r), std::fabs(p.g - q.g), std::fabs(p.b - q.b)}) /
      std::min(std::max({p.r, p.g, p.b}), std::max({q.r, q.g, q.b}));
  return std::max({a.y / b.y - 1.0, b.y / a.y - 1.0, color});
}

// `sky_changes` finds the steepest places.
TEST(AtmosphereSky, ChangesByLessThanFivePercentInATenthOfADegree) {
  struct Air {
    double turbidity, albedo;
  };
  for (const Air& air :
       {Air{1.5, 0.15}, Air{2.34, 0.0}, Air{3.3, 0.0}, Air{4.2, 0.0}, Air{20.0, 1.0}}) {
    const auto tables =
        std::make_shared<const AtmosphereTables>(AerosolOfTurbidity(air.turbidity), air.albedo);
    for (const double sun : {-6.0, -2.0, -0.3, 0.04, 0.39, 0.7, 1.2, 3.0, 20.0, 60.0, 90.0}) {
      const AtmosphereSky sky(tables, Towards(kSunAzimuth, sun), 1.0);
      const auto at = [&](double azimuth_from_sun, double elevation) {
        return sky.Xyz(Towards(kSunAzimuth + azimuth_from_sun, elevation));
      };
      for (const double azimuth : {0.0, 1.0, 20.0, 90.0, 180.0}) {
        for (int i = 0; i < 1798; ++i) {
          const double e = 0.05 * i;
          ASSERT_LT(ChangeOfLight(at(azimuth, e), at(azimuth, e + 0.1)), 0.048)
              << air.turbidity << ", sun " << sun << ", upwards from " << azimuth << " " << e;
        }
      }
      for (const double elevation : {0.0, 2.0, std::max(sun, 0.0), 45.0, 89.8}) {
        for (int i = -1800; i < 1800; ++i) {
          const double azimuth = 0.1 * i;
          ASSERT_LT(ChangeOfLight(at(azimuth, elevation), at(azimuth + 0.1, elevation)), 0.048)
              << air.turbidity << ", sun " << sun << ", around from " << azimuth << " "
              << elevation;
        }
      }
    }
  }
}

TEST(AtmosphereSky, SoftensNothingButTheHorizon) {
  const auto softened = [](double elevation, double sun) {
    return AtmosphereSky::SoftenedElevation(elevation * kRadiansPerDegree,
                                            sun * kRadiansPerDegree) /
           kRadiansPerDegree;
  };
  EXPECT_NEAR(softened(0.0, 30.0), 2.9 / std::exp(1.0), 1e-9);
  EXPECT_DOUBLE_EQ(softened(3.0, 30.0), 3.0);
  // Continuous, with a continuous slope.
  EXPECT_NEAR(softened(2.9, 30.0) - softened(2.8, 30.0), 0.1, 2e-3);
  for (int i = 0; i < 900; ++i) {
    const double elevation = 0.1 * i;
    ASSERT_GE(softened(elevation, -6.0), elevation - 1e-9);
    ASSERT_GT(softened(elevation + 0.1, -6.0), softened(elevation, -6.0));
  }
}

// Under a low sun the sky changes by more than 5 % in 0.1°. The path tracer's sky does too; both of
// its suns use the same paths.
TEST(AtmosphereSky, FollowsALowSunAsFastAsAPathTracedSkyDoes) {
  struct Move {
    double turbidity, sun, azimuth, elevation;
  };
  for (const Move& move : {Move{1.8, -2.6, 180.0, 10.0}, Move{1.8, 0.4, 0.0, 0.0},
                           Move{2.34, 1.0, 0.0, 0.0}, Move{3.5, 2.0, 0.0, 5.0}}) {
    const auto tables = TablesOf(move.turbidity);
    const auto ours = [&](double sun) {
      return LuminanceAt(AtmosphereSky(tables, Towards(kSunAzimuth, sun), 1.0), move.azimuth,
                         move.elevation);
    };
    const double seen = AtmosphereSky::SoftenedElevation(move.elevation * kRadiansPerDegree,
                                                         move.sun * kRadiansPerDegree) /
                        kRadiansPerDegree;
    const auto truth = [&](double sun) {
      return reference::PathTracedSky({AerosolOfTurbidity(move.turbidity), 0.15, sun})
          .At(seen, move.azimuth, 400, 1)
          .luminance;
    };
    const double change = ours(move.sun + 0.1) / ours(move.sun) - 1.0;
    EXPECT_GT(change, 0.05);
    EXPECT_NEAR(change, truth(move.sun + 0.1) / truth(move.sun) - 1.0, 0.03)
        << move.turbidity << ", sun " << move.sun;
  }
}

// The sun's motion itself changes the sky. A jump is what remains after the trend of the two
// neighbouring steps is subtracted.
TEST(AtmosphereSky, FollowsTheSunWithoutAJump) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> elevations(-6.0, 15.0);
  for (const double turbidity : {1.5, 3.0, 20.0}) {
    const auto tables = TablesOf(turbidity);
    for (int i = 0; i < 12; ++i) {
      // Every fourth step is at a sun elevation that the tables contain.
      const double sun =
          i % 4 == 0 ? ScatteredLight::SunElevationDeg(6 + 2 * i) : elevations(random);
      const AtmosphereSky before(tables, Towards(kSunAzimuth, sun - 0.1), 1.0);
      const AtmosphereSky now(tables, Towards(kSunAzimuth, sun), 1.0);
      const AtmosphereSky after(tables, Towards(kSunAzimuth, sun + 0.1), 1.0);
      for (const double azimuth : {0.0, 60.0, 180.0}) {
        for (const double elevation : {0.0, 1.0, 5.0, 30.0, 80.0}) {
          const double trend = std::sqrt(LuminanceAt(before, azimuth, elevation) *
                                         LuminanceAt(after, azimuth, elevation));
          ASSERT_NEAR(LuminanceAt(now, azimuth, elevation) / trend, 1.0, 0.05)
              << turbidity << ", sun " << sun << ", at " << azimuth << " " << elevation;
        }
      }
    }
  }
}

TEST(AtmosphereSky, DarkensThroughTwilightToTheStars) {
  const auto tables = TablesOf(kDefaultTurbidity);
  const auto lux = [&](double sun) {
    const AtmosphereSky sky(tables, Towards(kSunAzimuth, sun), 1.0);
    return IntegrateProjectedDome([&](Direction<World> from) { return sky.Xyz(from).y; });
  };
  double last = lux(2.0);
  for (double sun = 1.0; sun > -18.5; sun -= 1.0) {
    const double now = lux(sun);
    EXPECT_LT(now, last) << sun;
    last = now;
  }
  // Seidelmann 1992, Table 8.2, by altitude without refraction. Here refraction is included: half a
  // degree.
  EXPECT_GT(lux(0.0), 600.0);
  EXPECT_LT(lux(0.0), 1'100.0);
  EXPECT_GT(lux(-6.0), 2.0);
  EXPECT_LT(lux(-6.0), 8.0);
  // Nautical and astronomical twilight.
  EXPECT_NEAR(lux(-9.0) / 0.117, 1.0, 0.15);
  EXPECT_NEAR(lux(-12.0) / 0.0081, 1.0, 0.15);
  EXPECT_NEAR(lux(-15.0) / 0.00204, 1.0, 0.15);
  EXPECT_NEAR(lux(-30.0), 6.5e-4, 1e-5);
}

TEST(AtmosphereSky, LooksLikeASky) {
  const auto tables = TablesOf(kDefaultTurbidity);
  const AtmosphereSky noon(tables, Towards(kSunAzimuth, 45.0), 1.0);
  // Brighter towards the horizon, a glow around the sun, blue away from it.
  EXPECT_GT(LuminanceAt(noon, 180.0, 3.0), 2.0 * LuminanceAt(noon, 180.0, 45.0));
  EXPECT_GT(LuminanceAt(noon, 0.0, 43.0), 5.0 * LuminanceAt(noon, 180.0, 45.0));
  const XyY away = XyYFromXyz(noon.Xyz(Towards(kSunAzimuth + 180.0, 45.0)));
  EXPECT_LT(away.x, 0.28);
  const AtmosphereSky dusk(tables, Towards(kSunAzimuth, 1.0), 1.0);
  const XyY glow = XyYFromXyz(dusk.Xyz(Towards(kSunAzimuth, 2.0)));
  EXPECT_GT(glow.x, 0.42);
  const LinearRgb sun = RgbFromXyY(XyYFromXyz(SunXyz(*tables, Towards(kSunAzimuth, 2.0), 1.0)));
  EXPECT_GT(sun.r, 2.0 * sun.g);
  EXPECT_GT(sun.g, 3.0 * sun.b);
}

TEST(AtmosphereModel, HasTheIesDiffuseShareOnAnOrdinaryClearDay) {
  const auto source = SkySource::Create({SkyModelKind::kAtmosphere, 0}, {});
  ASSERT_TRUE(source.has_value());
  for (double elevation = 10.0; elevation <= 70.0; elevation += 5.0) {
    const auto sky = (*source)->ForSun(Towards(180.0, elevation), 1.0);
    const double up = std::sin(elevation * kRadiansPerDegree);
    const double diffuse = Luminance(sky->SkyHorizontalIrradiance());
    const double direct = Luminance(sky->SunNormalIrradiance()) * up;
    // IES RP-21, clear: 0.8 + 15.5 √(sin a) and 127.5 e^(−0.21 / sin a) klx.
    const double ies_sky = 800.0 + 15'500.0 * std::sqrt(up);
    const double ies_sun = 127'500.0 * std::exp(-0.21 / up) * up;
    EXPECT_NEAR((diffuse / (diffuse + direct)) / (ies_sky / (ies_sky + ies_sun)), 1.0, 0.06)
        << elevation;
    EXPECT_NEAR(diffuse / ies_sky, 1.0, 0.12) << elevation;
    EXPECT_NEAR(direct / ies_sun, 1.0, 0.10) << elevation;
  }
}

TEST(AtmosphereModel, GivesTheSameSkyWhetherTheSunCameOrWasThere) {
  const auto source = SkySource::Create({SkyModelKind::kAtmosphere, 0}, {});
  ASSERT_TRUE(source.has_value());
  for (double sun = -6.0; sun < 60.0; sun += 9.7) (*source)->ForSun(Towards(90.0, sun), 1.0);
  const auto moved = (*source)->ForSun(Towards(200.0, 33.0), 1.01);
  const auto fresh = CreateSkyModel({SkyModelKind::kAtmosphere, 0}, {}, Towards(200.0, 33.0), 1.01);
  ASSERT_TRUE(fresh.has_value());
  EXPECT_EQ(moved->SunNormalIrradiance(), (*fresh)->SunNormalIrradiance());
  EXPECT_EQ(moved->SkyHorizontalIrradiance(), (*fresh)->SkyHorizontalIrradiance());
  EXPECT_EQ(moved->SkyRadiance(Towards(17.0, 8.0)), (*fresh)->SkyRadiance(Towards(17.0, 8.0)));
}

TEST(AtmosphereModel, IntegratesToItsHorizontalIlluminance) {
  const auto sky = CreateSkyModel({SkyModelKind::kAtmosphere, 0}, {}, Towards(120.0, 25.0));
  ASSERT_TRUE(sky.has_value());
  double sum = 0.0;
  constexpr int kRings = 400, kSectors = 400;
  for (int i = 0; i < kRings; ++i) {
    const double up = (i + 0.5) / kRings;  // Uniform in solid angle.
    for (int j = 0; j < kSectors; ++j) {
      const double elevation = std::asin(up) / kRadiansPerDegree;
      sum += up * (*sky)->At(Towards(360.0 * (j + 0.5) / kSectors, elevation)).luminance;
    }
  }
  sum *= 2.0 * M_PI / (kRings * kSectors);
  EXPECT_NEAR(Luminance((*sky)->SkyHorizontalIrradiance()) / sum, 1.0, 2e-3);
}

TEST(AtmosphereModel, DimsWithTheDistanceOfTheSun) {
  const auto source = SkySource::Create({SkyModelKind::kAtmosphere, 0}, {});
  ASSERT_TRUE(source.has_value());
  const auto near = (*source)->ForSun(Towards(0.0, 40.0), 0.98);
  const auto far = (*source)->ForSun(Towards(0.0, 40.0), 1.02);
  const double ratio = std::pow(1.02 / 0.98, 2);
  EXPECT_NEAR(
      Luminance(near->SkyHorizontalIrradiance()) / Luminance(far->SkyHorizontalIrradiance()), ratio,
      1e-3);
  EXPECT_NEAR(Luminance(near->SunNormalIrradiance()) / Luminance(far->SunNormalIrradiance()), ratio,
              1e-3);
}

TEST(ScatteringLayers, KeepAnEvenFieldEvenWithoutAbsorption) {
  for (const double g : {0.0, 0.65, 0.78, 0.9}) {
    const internal::PhaseMatrices phases(g);
    internal::LevelField even{}, source{};
    even.above[0].fill(Spectrum::Of(1.0F));
    even.below[0].fill(Spectrum::Of(1.0F));
    phases.Scatter(even, Spectrum::Of(0.3F), Spectrum::Of(0.7F), &source);
    for (int i = 0; i < internal::kGauss; ++i) {
      EXPECT_NEAR(source.above[0][i].v[3], 1.0F, 2e-5);
      EXPECT_NEAR(source.below[0][i].v[0], 1.0F, 2e-5);
      EXPECT_EQ(source.above[1][i].v[0], 0.0F);
    }
  }
}

// Kasten & Young's air masses at 30° and 5° are 1.994 and 10.3; high-altitude ozone lowers them.
TEST(OpticalDepthTable, GrowsAsTheAirMass) {
  const AirMedium medium(Aerosol{.beta = 0.0}, 0.0);
  const OpticalDepthTable depths(medium);
  const double zenith = depths.ToSpace(0.0, 1.0).v[0];
  EXPECT_NEAR(zenith, medium.molecules.v[0] * 8'000.0 + medium.ozone.v[0] * 15'000.0,
              2e-3 * zenith);
  EXPECT_NEAR(depths.ToSpace(0.0, std::sin(30.0 * kRadiansPerDegree)).v[0] / zenith, 1.994, 0.01);
  EXPECT_NEAR(depths.ToSpace(0.0, std::sin(5.0 * kRadiansPerDegree)).v[0] / zenith, 10.2, 0.2);
  // Through the whole atmosphere: twice the path from the lowest point.
  const double grazing_mu = -std::sqrt(1.0 - std::pow(6'370.0 / 6'380.0, 2));
  EXPECT_NEAR(
      depths.ToSpace(20'000.0, grazing_mu).v[0] + depths.ToSpace(20'000.0, -grazing_mu).v[0],
      2.0 * depths.ToSpace(10'000.0, 0.0).v[0], 1e-2 * depths.ToSpace(10'000.0, 0.0).v[0]);
}

}  // namespace
}  // namespace pleinair::sky
