#include "sky/sky_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sky/dome.h"
#include "sky/perez.h"

namespace pleinair::sky {
namespace {

using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Direction<World> SunAt(double elevation_deg) {
  const double elevation = elevation_deg * kRadiansPerDegree;
  return {{0.0, -std::cos(elevation), std::sin(elevation)}};
}

TEST(SkyModelName, IsReadAsWritten) {
  for (const char* name : {"atmosphere", "perez", "cie:1", "cie:9", "cie:15"}) {
    const auto parsed = ParseSkyModelName(name);
    ASSERT_TRUE(parsed.has_value()) << name;
    EXPECT_EQ(ToString(*parsed), name);
  }
}

TEST(SkyModelName, OfNoModelIsRefusedByName) {
  for (const char* name : {"", "Perez", "hosek", "cie", "cie:", "cie:0", "cie:16", "cie:1x",
                           "cie:-1", "cie: 3", "cie:99999999999999999999"}) {
    const auto parsed = ParseSkyModelName(name);
    ASSERT_FALSE(parsed.has_value()) << name;
    EXPECT_EQ(parsed.error().kind, ErrorKind::kInput);
    EXPECT_THAT(parsed.error().Message(), HasSubstr("cie:15"));
  }
}

Result<std::shared_ptr<const SkySource>> Create(SkyModelKind kind, void (*change)(SkyConditions*)) {
  SkyConditions conditions;
  change(&conditions);
  return SkySource::Create({kind, kind == SkyModelKind::kCie ? 12 : 0}, conditions);
}

TEST(SkySource, RefusesWhatIsImpossible) {
  constexpr SkyModelKind kPerez = SkyModelKind::kPerez, kCie = SkyModelKind::kCie;
  const Result<std::shared_ptr<const SkySource>> all[] = {
      Create(kPerez, [](SkyConditions* c) { c->turbidity = 0.5; }),
      Create(kPerez, [](SkyConditions* c) { c->turbidity = 31.0; }),
      Create(kPerez, [](SkyConditions* c) { c->turbidity = kNan; }),
      Create(kPerez, [](SkyConditions* c) { c->ground_albedo = 1.1; }),
      Create(kPerez, [](SkyConditions* c) { c->cloud_cover = -0.1; }),
      Create(kPerez, [](SkyConditions* c) { c->cloud_cover = kNan; }),
      Create(kPerez, [](SkyConditions* c) { c->aerosol = Aerosol{}; }),
      Create(kPerez, [](SkyConditions* c) { c->zenith_luminance = CandelaPerM2(1.0); }),
      Create(kCie, [](SkyConditions* c) { c->cloud_cover = 0.5; }),
      Create(kCie, [](SkyConditions* c) { c->zenith_luminance = CandelaPerM2(kNan); }),
      Create(kCie, [](SkyConditions* c) { c->sky_horizontal_illuminance = Lux(-1.0); }),
      Create(kCie,
             [](SkyConditions* c) {
               c->zenith_luminance = CandelaPerM2(1.0);
               c->sky_horizontal_illuminance = Lux(1.0);
             }),
      Create(SkyModelKind::kAtmosphere,
             [](SkyConditions* c) {
               c->aerosol = Aerosol{};
               c->aerosol->asymmetry = 1.0;
             }),
  };
  for (const auto& result : all) {
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().kind, ErrorKind::kInput);
    EXPECT_FALSE(result.error().remedy.empty());
  }
}

TEST(PerezModel, IsPreethamsSky) {
  SkyConditions conditions;
  conditions.turbidity = 3.0;
  const auto sky = CreateSkyModel({SkyModelKind::kPerez, 0}, conditions, SunAt(30.0));
  ASSERT_TRUE(sky.has_value());
  const Direction<World> up{{0.0, 0.0, 1.0}};
  EXPECT_NEAR((*sky)->At(up).luminance, 5139.2, 0.1);
  EXPECT_EQ((*sky)->At(up).x, PerezSky(3.0, SunAt(30.0)).At(up).x);
  EXPECT_TRUE((*sky)->Notes().empty());
}

TEST(PerezModel, SaysWhenItClamps) {
  for (const double turbidity : {1.5, 20.0}) {
    SkyConditions conditions;
    conditions.turbidity = turbidity;
    conditions.cloud_cover = 0.3;
    const auto sky = CreateSkyModel({SkyModelKind::kPerez, 0}, conditions, SunAt(30.0));
    ASSERT_TRUE(sky.has_value());
    ASSERT_EQ((*sky)->Notes().size(), 1U);
    EXPECT_THAT((*sky)->Notes()[0], HasSubstr("outside the range of perez, 2 to 10"));
  }
}

}  // namespace
}  // namespace pleinair::sky
