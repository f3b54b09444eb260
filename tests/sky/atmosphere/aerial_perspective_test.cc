#include "sky/atmosphere/aerial_perspective.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sky/atmosphere/atmosphere.h"
#include "sky/sky_model.h"
#include "tests/sky/reference/path_traced_sky.h"

namespace pleinair::sky {
namespace {

Direction<World> Towards(double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * kRadiansPerDegree;
  const double elevation = elevation_deg * kRadiansPerDegree;
  return {{std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
           std::sin(elevation)}};
}

TEST(AerialPerspective, IsNothingAtNoDistance) {
  const AtmosphereTables tables(AerosolOfTurbidity(3.0), 0.15);
  const AerialPerspective air(tables, Towards(90.0, 30.0), 1.0);
  EXPECT_EQ(air.Transmittance(Towards(10.0, 0.0), Metres(0.0)), (LinearRgb{1.0, 1.0, 1.0}));
  EXPECT_EQ(air.Inscattered(Towards(10.0, 0.0), Metres(0.0)), LinearRgb{});
}

TEST(AerialPerspective, AgreesWithAPathTracer) {
  for (const double turbidity : {1.85, 6.0}) {
    const Aerosol aerosol = AerosolOfTurbidity(turbidity);
    const AtmosphereTables tables(aerosol, 0.15);
    for (const double sun : {8.0, 45.0}) {
      const AerialPerspective air(tables, Towards(0.0, sun), 1.0);
      const reference::PathTracedSky truth({aerosol, 0.15, sun});
      for (const double distance : {2'000.0, 20'000.0}) {
        for (const double azimuth : {20.0, 90.0, 170.0}) {
          const double elevation = 1.0;
          const double expected = truth.At(elevation, azimuth, 500, 3, distance).luminance;
          const double got =
              Luminance(air.Inscattered(Towards(azimuth, elevation), Metres(distance)));
          EXPECT_NEAR(got / expected, 1.0, 0.12) << "turbidity " << turbidity << ", sun " << sun
                                                 << ", " << distance << " m at " << azimuth;
        }
      }
    }
  }
}

TEST(AerialPerspective, TakesMoreAndAddsMoreWithDistanceButNoMoreThanTheHorizon) {
  const AtmosphereTables tables(AerosolOfTurbidity(4.0), 0.15);
  const AerialPerspective air(tables, Towards(0.0, 30.0), 1.0);
  for (const double elevation : {-20.0, -1.0, 0.0, 1.0, 40.0}) {
    double light = 0.0, through = 1.0;
    for (double distance = 10.0; distance < 3e5; distance *= 1.5) {
      const LinearRgb added = air.Inscattered(Towards(60.0, elevation), Metres(distance));
      const LinearRgb left = air.Transmittance(Towards(60.0, elevation), Metres(distance));
      EXPECT_GE(Luminance(added), light * (1.0 - 1e-12));
      EXPECT_LE(Luminance(left), through);
      EXPECT_GE(std::min({added.r, added.g, added.b}), 0.0);
      EXPECT_LE(left.b, left.r);  // Distant surfaces redden; the airlight is blue.
      light = Luminance(added);
      through = Luminance(left);
    }
    EXPECT_LT(light, 4e4);
  }
}

// Koschmieder: 5 % of the contrast remain at the meteorological range.
TEST(AerialPerspective, HidesMoreInHaze) {
  const auto range_km = [](double turbidity) {
    const AtmosphereTables tables(AerosolOfTurbidity(turbidity), 0.15);
    const AerialPerspective air(tables, Towards(0.0, 30.0), 1.0);
    double distance = 100.0;
    while (Luminance(air.Transmittance(Towards(90.0, 0.0), Metres(distance))) > 0.05) {
      distance *= 1.02;
    }
    return distance * 1e-3;
  };
  EXPECT_GT(range_km(1.0), 200.0);
  EXPECT_NEAR(range_km(1.85), 36.0, 10.0);
  EXPECT_LT(range_km(10.0), 5.0);
}

TEST(AirTo, IsClearWithModelsThatHaveNoAir) {
  for (const SkyModelName name : {SkyModelName{SkyModelKind::kPerez, 0}, {SkyModelKind::kCie, 3}}) {
    const auto sky = CreateSkyModel(name, {}, Towards(0.0, 30.0));
    ASSERT_TRUE(sky.has_value());
    const auto air = (*sky)->AirTo(Towards(10.0, 0.0), Metres(1e4));
    EXPECT_EQ(air.transmittance, (LinearRgb{1.0, 1.0, 1.0}));
    EXPECT_EQ(air.inscattered, LinearRgb{});
  }
}

}  // namespace
}  // namespace pleinair::sky
