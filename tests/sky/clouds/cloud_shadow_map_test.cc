#include "sky/clouds/cloud_shadow_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/units.h"
#include "sky/sun/solar_disc.h"

namespace pleinair::clouds {
namespace {

constexpr GroundBox kSite{{-150.0, -90.0, -2.0}, {200.0, 120.0, 30.0}};

Direction<World> SunAt(double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * kRadiansPerDegree;
  const double elevation = elevation_deg * kRadiansPerDegree;
  return {{std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
           std::sin(elevation)}};
}

CloudFields FieldsOf(const std::vector<std::string>& layers) {
  std::vector<CloudLayer> parsed;
  parsed.reserve(layers.size());
  for (const std::string& layer : layers) parsed.push_back(ParseCloudLayer(layer).value());
  return MakeFields(parsed);
}

/// Largest and mean difference from SunTransmittance() on ground and roofs.
struct Difference {
  double largest = 0.0, mean = 0.0;
};
Difference FromPoints(const CloudFields& fields, Direction<World> sun, double seconds) {
  const CloudShadowMap map = MakeCloudShadowMap(fields, kSite, sun, seconds);
  Difference difference;
  constexpr int kPoints = 120;
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 point{-150.0 + 350.0 * std::fmod(0.618 * i, 1.0),
                     -90.0 + 210.0 * std::fmod(0.755 * i, 1.0), i % 3 == 0 ? 12.0 : 0.0};
    const double error = std::fabs(map.At(point) - SunTransmittance(fields, point, sun, seconds));
    difference.largest = std::max(difference.largest, error);
    difference.mean += error / kPoints;
  }
  return difference;
}

TEST(CloudShadowMap, AgreesWithTheTransmittanceOfPoints) {
  // The seconds bring an edge of a cloud over the site.
  const CloudFields cumulus = FieldsOf({"kind=cumulus,wind_m_s=10,wind_from_deg=250"});
  const CloudFields two =
      FieldsOf({"kind=cumulus,wind_m_s=10,wind_from_deg=250", "kind=altocumulus,seed=4"});
  for (const double elevation : {8.0, 40.0, 90.0}) {
    for (const double seconds : {0.0, 35.0, 80.0}) {
      for (const CloudFields& fields : {cumulus, two}) {
        const Difference found = FromPoints(fields, SunAt(200, elevation), seconds);
        // The disc's edge is 9 m wide at the clouds under a high sun, 14 m at 40°. Between texels
        // of 5 m its curvature leaves that much.
        EXPECT_LT(found.mean, elevation > 45.0 ? 0.008 : 0.004) << elevation << " " << seconds;
        EXPECT_LT(found.largest, 0.08) << elevation << " " << seconds;
      }
    }
  }
}

TEST(CloudShadowMap, FollowsTheWindToAMetre) {
  const CloudFields fields = FieldsOf({"kind=cumulus,cover=0.5,wind_m_s=10,wind_from_deg=270"});
  const GroundBox strip{{-1500.0, -10.0, 0.0}, {1500.0, 10.0, 0.0}};
  const Direction<World> sun = SunAt(180, 50);
  const CloudShadowMap before = MakeCloudShadowMap(fields, strip, sun, 0.0);
  const CloudShadowMap after = MakeCloudShadowMap(fields, strip, sun, 12.0);
  double best = 1e300;
  int best_shift = 0;
  for (int shift = 100; shift <= 140; ++shift) {  // Metres to the east.
    double squares = 0.0;
    for (int x = -1300; x < 1300; x += 7) {
      const double change = after.At({x + 1.0 * shift, 0.0, 0.0}) - before.At({1.0 * x, 0.0, 0.0});
      squares += change * change;
    }
    if (squares < best) {
      best = squares;
      best_shift = shift;
    }
  }
  EXPECT_NEAR(best_shift, 120, 1);
}

// The disc of a sun of the width W lets the transmittance change by 4/(π W) a metre at most.
TEST(CloudShadowMap, ChangesNoFasterThanTheDiscAllows) {
  const CloudFields fields = FieldsOf({"kind=cumulus,optical_depth=80,cover=0.5"});
  for (const double elevation : {20.0, 60.0}) {
    const double rise = std::sin(elevation * kRadiansPerDegree);
    const double width = 2.0 * sky::kSolarRadiusAt1Au * 1450.0 / rise;
    const CloudShadowMap map =
        MakeCloudShadowMap(fields, {{-300, -300, 0}, {300, 300, 0}}, SunAt(90, elevation), 0.0);
    double steepest = 0.0;
    for (int row = 0; row < map.height; ++row) {
      for (int column = 1; column < map.width; ++column) {
        const float* at = &map.share[static_cast<std::size_t>(row) * map.width + column];
        steepest = std::max(steepest, std::fabs(at[0] - at[-1]) / map.texel_m);
      }
    }
    EXPECT_LE(steepest, 1.1 * 4.0 / (3.14159 * width)) << elevation;
    EXPECT_GT(map.Mean(), 0.0);
  }
}

TEST(CloudShadowMap, IsEvenUnderASlabAndDarkAtNight) {
  const CloudFields slab = FieldsOf({"kind=slab,optical_depth=0.5"});
  const CloudShadowMap map = MakeCloudShadowMap(slab, kSite, SunAt(120, 30), 0.0);
  EXPECT_NEAR(map.At({20, 30, 5}), std::exp(-1.0), 1e-3);
  EXPECT_NEAR(map.Mean(), std::exp(-1.0), 1e-3);
  EXPECT_EQ(MakeCloudShadowMap(slab, kSite, SunAt(120, -1), 0.0).Mean(), 0.0);
  EXPECT_EQ(MakeCloudShadowMap({}, kSite, SunAt(120, 30), 0.0).Mean(), 1.0);
}

TEST(CloudShadowMap, StaysSmallOverLargeSites) {
  const CloudFields fields = FieldsOf({"kind=cumulus"});
  const CloudShadowMap map =
      MakeCloudShadowMap(fields, {{-4000, -50, 0}, {4000, 50, 10}}, SunAt(150, 35), 0.0);
  EXPECT_LE(map.width, kMaxShadowSide);
  EXPECT_LE(map.height, kMaxShadowSide);
  EXPECT_GT(map.texel_m, kShadowTexel_m);
}

}  // namespace
}  // namespace pleinair::clouds
