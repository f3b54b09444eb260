#include "sky/clouds/cloud_sky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "base/parallel_for.h"
#include "sky/clouds/cloud_phase.h"
#include "sky/clouds/cloud_slab.h"
#include "sky/dome.h"
#include "sky/henyey_greenstein.h"

namespace pleinair::clouds {
namespace {

Direction<World> Towards(double azimuth_deg, double elevation_deg) {
  const double azimuth = azimuth_deg * kRadiansPerDegree;
  const double elevation = elevation_deg * kRadiansPerDegree;
  return {{std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
           std::sin(elevation)}};
}

std::unique_ptr<sky::SkyModel> Clear(double elevation_deg, double albedo) {
  sky::SkyConditions conditions;
  conditions.ground_albedo = albedo;
  return *sky::CreateSkyModel({sky::SkyModelKind::kAtmosphere, 0}, conditions,
                              Towards(180, elevation_deg));
}

std::unique_ptr<CloudSky> Sky(const std::string& layer, double elevation_deg,
                              double albedo = 0.15) {
  return std::make_unique<CloudSky>(Clear(elevation_deg, albedo),
                                    MakeFields({ParseCloudLayer(layer).value()}), albedo, 0.0);
}

double Global(const sky::SkyModel& sky) {
  return Luminance(sky.SkyHorizontalIrradiance() +
                   sky.SunNormalIrradiance() * std::max(0.0, sky.ToSun().xyz.z));
}

TEST(CloudPhase, IsNormalised) {
  for (const auto& phase : {+[](double c) { return sky::HenyeyGreenstein(0.85, c); },
                            +[](double c) { return sky::HenyeyGreenstein(0.77, c); },
                            +[](double c) { return DropletPhase(10.0, c); }}) {
    constexpr int kSteps = 200'000;
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double x = (i + 0.5) / kSteps, angle = std::numbers::pi * x * x * x;
      sum += phase(std::cos(angle)) * std::sin(angle) * 3.0 * std::numbers::pi * x * x / kSteps;
    }
    EXPECT_NEAR(0.5 * sum, 1.0, 1e-6);
  }
}

// Droplets have a fogbow near 140° and a glory at 180°; Henyey–Greenstein has neither.
TEST(CloudPhase, OfDropletsRisesBackwards) {
  EXPECT_GT(DropletPhase(10.0, -1.0), 1.5 * DropletPhase(10.0, std::cos(1.8)));
  EXPECT_LT(sky::HenyeyGreenstein(0.85, -1.0), sky::HenyeyGreenstein(0.85, std::cos(1.8)));
}

TEST(CloudSky, UnderASlabHasTheIlluminanceOfTheTable) {
  for (const double albedo : {0.0, 0.2, 0.8}) {
    for (const double elevation : {10.0, 40.0, 70.0}) {
      // The ground's share of the light does not depend on the sun.
      if (albedo != 0.2 && elevation != 40.0) continue;
      for (const double depth : {0.5, 8.0, 32.0}) {
        const auto sky = Sky("kind=slab,optical_depth=" + std::to_string(depth), elevation, albedo);
        const double cosine = sky->ToSun().xyz.z;
        const LightAbove light{Luminance(sky->clear().SunNormalIrradiance()) * cosine, cosine,
                               Luminance(sky->clear().SkyHorizontalIrradiance())};
        const double expected = IlluminanceBelow(SlabTable::Water(), depth, light, albedo);
        EXPECT_NEAR(Global(*sky) / expected, 1.0, 0.02)
            << "albedo " << albedo << " elevation " << elevation << " depth " << depth;
        const AreaLight& area = sky->area();
        EXPECT_NEAR(Luminance(area.sun_horizontal + area.sky_horizontal) / expected, 1.0, 1e-3);
      }
    }
  }
}

// The sum over a map, as `pleinair sky` writes it. SkyHorizontalIrradiance() has another grid.
TEST(CloudSky, IntegratesToItsHorizontalIlluminance) {
  struct Kind {
    const char* name;
    int map_width;  // The edges of small clouds are sharp.
  };
  for (const Kind kind : {Kind{"cumulus", 512}, Kind{"stratocumulus", 256}, Kind{"stratus", 256},
                          Kind{"altocumulus", 512}, Kind{"cirrus", 256}, Kind{"slab", 256}}) {
    for (const double elevation : {10.0, 40.0, 70.0}) {
      const auto sky = Sky("kind=" + std::string(kind.name), elevation);
      const double step_deg = 360.0 / kind.map_width;
      std::vector<double> rows(static_cast<std::size_t>(kind.map_width) / 4);
      ParallelFor(rows.size(), 0, [&](std::size_t row) {
        const double up_deg = 90.0 - (static_cast<double>(row) + 0.5) * step_deg;
        const double up = up_deg * kRadiansPerDegree;
        for (int column = 0; column < kind.map_width; ++column) {
          rows[row] += Luminance(sky->SkyRadiance(Towards((column + 0.5) * step_deg, up_deg))) *
                       std::cos(up) * std::sin(up);
        }
      });
      double sum = std::accumulate(rows.begin(), rows.end(), 0.0);
      sum *= std::pow(step_deg * kRadiansPerDegree, 2);
      EXPECT_NEAR(sum / Luminance(sky->SkyHorizontalIrradiance()), 1.0, 0.02)
          << kind.name << " " << elevation;
    }
  }
}

TEST(CloudSky, WithoutCloudsIsTheClearSky) {
  const auto sky = Sky("kind=cumulus,cover=0", 35.0);
  for (const double elevation : {2.0, 30.0, 88.0}) {
    EXPECT_EQ(sky->SkyRadiance(Towards(40, elevation)),
              sky->clear().SkyRadiance(Towards(40, elevation)));
  }
  EXPECT_EQ(sky->sun_transmittance(), 1.0);
}

TEST(CloudSky, StaysFiniteWithoutASun) {
  const auto sky = Sky("kind=cumulus", -3.0);
  EXPECT_EQ(Luminance(sky->SunNormalIrradiance()), 0.0);
  EXPECT_FALSE(sky->Notes().empty());
  for (const double elevation : {-5.0, 0.0, 0.3, 20.0, 90.0}) {
    const LinearRgb light = sky->SkyRadiance(Towards(10, elevation));
    EXPECT_TRUE(std::isfinite(Luminance(light)) && light.r >= 0.0 && light.b >= 0.0);
  }
}

// What a higher layer takes of the sun is missing below.
TEST(CloudSky, ShadesLowerLayersByHigherOnes) {
  const auto layers = [](const char* upper) {
    return MakeFields(
        {ParseCloudLayer("kind=slab,optical_depth=2").value(), ParseCloudLayer(upper).value()});
  };
  const CloudSky thin(Clear(40, 0.15), layers("kind=slab,optical_depth=0.1,base_m=6000"), 0.15, 0);
  const CloudSky thick(Clear(40, 0.15), layers("kind=slab,optical_depth=6,base_m=6000"), 0.15, 0);
  EXPECT_LT(Global(thick), 0.7 * Global(thin));
  const AreaLight& area = thick.area();
  EXPECT_NEAR(Luminance(area.sun_horizontal + area.sky_horizontal) / Global(thick), 1.0, 0.05);
}

}  // namespace
}  // namespace pleinair::clouds
