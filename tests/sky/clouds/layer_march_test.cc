#include "sky/clouds/layer_march.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "base/parallel_for.h"
#include "base/units.h"
#include "sky/clouds/cloud_phase.h"
#include "sky/clouds/cloud_sky.h"
#include "sky/henyey_greenstein.h"

namespace pleinair::clouds {
namespace {

using std::numbers::pi;

/// A sun of unit illuminance in a black sky.
class SunAlone : public sky::SkyModel {
 public:
  explicit SunAlone(Vec3 to_sun) : to_sun_(to_sun) {}

  LinearRgb SkyRadiance(Direction<World> /*from*/) const override { return {}; }
  LinearRgb SunNormalIrradiance() const override { return {1.0, 1.0, 1.0}; }
  LinearRgb SkyHorizontalIrradiance() const override { return {}; }
  Direction<World> ToSun() const override { return {to_sun_}; }

 private:
  Vec3 to_sun_;
};

Vec3 SouthernSun(double elevation_deg) {
  const double elevation = elevation_deg * kRadiansPerDegree;
  return {0.0, -std::cos(elevation), std::sin(elevation)};
}

std::shared_ptr<const CloudField> FieldOf(const std::string& text) {
  return CloudField::Of(ParseCloudLayer(text).value());
}

using Random = std::mt19937_64;
double Uniform(Random* random) { return static_cast<double>((*random)() >> 11U) * 0x1.0p-53; }

Vec3 About(Vec3 axis, double cosine, Random* random) {
  const Vec3 aside = std::fabs(axis.z) < 0.9 ? Vec3{0.0, 0.0, 1.0} : Vec3{1.0, 0.0, 0.0};
  const Vec3 x = Normalized(Cross(axis, aside)), y = Cross(axis, x);
  const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
  const double turn = 2.0 * pi * Uniform(random);
  return Normalized(axis * cosine + x * (sine * std::cos(turn)) + y * (sine * std::sin(turn)));
}

double HenyeyGreensteinBetween(Vec3 a, Vec3 b) {
  return sky::HenyeyGreenstein(kWaterAsymmetry, Dot(a, b)) / (4.0 * pi);
}

/// Witt 1977.
double HenyeyGreensteinCosine(Random* random) {
  constexpr double g = kWaterAsymmetry;
  const double s = (1.0 - g * g) / (1.0 - g + 2.0 * g * Uniform(random));
  return (1.0 + g * g - s * s) / (2.0 * g);
}

/// One sample of the scattered illuminance of level ground at the place, over that of the sun on a
/// surface that faces it. A path runs against the light; each scattering adds the sun's light.
/// Light that is scattered once has the phase function of droplets. The rest has
/// Henyey-Greenstein's, whose lower peak makes less noise.
double FollowToTheSun(const CloudField& field, Vec3 sun, double seconds, Random* random) {
  constexpr double kCone = 12.0 * kRadiansPerDegree;
  Vec3 along = Uniform(random) < 0.5 ? About({0.0, 0.0, 1.0}, std::sqrt(Uniform(random)), random)
                                     : About(sun, std::cos(kCone * Uniform(random)), random);
  if (along.z < 1e-3) return 0.0;
  const double from_sun = std::acos(std::clamp(Dot(along, sun), -1.0, 1.0));
  const double cone =
      from_sun < kCone ? 1.0 / (kCone * 2.0 * pi * std::max(1e-7, std::sin(from_sun))) : 0.0;
  const double weight = along.z / (0.5 * along.z / pi + 0.5 * cone);
  const CloudLayer& layer = field.layer();
  Vec3 at = along * (layer.base_m / along.z);
  double light = 0.0;
  double phase = CloudPhase(layer.kind, Dot(along, sun)) / (4.0 * pi);
  while (true) {
    do {
      at = at + along * (-std::log1p(-Uniform(random)) / field.MostExtinction());
      if (at.z > layer.base_m + layer.thickness_m || at.z < layer.base_m) return light;
    } while (Uniform(random) * field.MostExtinction() >= field.Extinction(at, seconds));
    light += weight * phase * std::exp(-field.DepthAlong(at, sun, seconds, 12));
    along = About(along, HenyeyGreensteinCosine(random), random);
    phase = HenyeyGreensteinBetween(along, sun);
  }
}

double ScatteredByPaths(const CloudField& field, Vec3 sun, double seconds, int paths) {
  constexpr int kGroups = 64;
  std::vector<double> sums(kGroups);
  ParallelFor(kGroups, 0, [&](std::size_t group) {
    Random random(group);
    for (int i = 0; i < paths / kGroups; ++i) {
      sums[group] += FollowToTheSun(field, sun, seconds, &random) / paths;
    }
  });
  double sum = 0.0;
  for (const double part : sums) sum += part;
  return sum;
}

// In gaps, sun and bright clouds together are stronger than an open sky. Paths show by how much.
TEST(CloudSky, LightsGapsAndEdgesAsPathsDo) {
  struct Case {
    double elevation_deg, seconds;
  };
  const auto field = FieldOf("kind=cumulus,cover=0.4,wind_m_s=8,wind_from_deg=250");
  double strongest = 0.0;
  for (const Case& at : {Case{40, 400}, {40, 430}, {70, 390}, {70, 490}}) {
    const Vec3 sun = SouthernSun(at.elevation_deg);
    const CloudSky sky(std::make_unique<SunAlone>(sun), {field}, 0.0, at.seconds);
    const double scattered = sky.SkyHorizontalIrradiance().g / sun.z;
    const double by_paths = ScatteredByPaths(*field, sun, at.seconds, 12'800) / sun.z;
    const double direct = sky.sun_transmittance();
    EXPECT_NEAR(direct + scattered, direct + by_paths, 0.08)
        << at.elevation_deg << " " << at.seconds << " " << direct;
    strongest = std::max(strongest, direct + by_paths);
  }
  EXPECT_GT(strongest, 1.2);
}

TEST(LayerMarch, ScattersInTheMeanWhatTheColumnsDo) {
  constexpr int kRays = 10'000;
  for (const char* kind : {"cumulus", "altocumulus"}) {
    for (const double elevation : {20.0, 70.0}) {
      const auto field = FieldOf("kind=" + std::string(kind));
      const Vec3 sun = SouthernSun(elevation);
      const double down = ComputeAreaLight({field}, SunAlone(sun), 0.0, 0.0).sky_horizontal.g;
      const HigherOrders higher(field->layer().kind, sun.z);
      const double scale = MeanHigherScale(*field, higher, sun, down);
      EXPECT_GT(scale, 0.4);
      EXPECT_LT(scale, 1.6);
      Random random(7);
      double sum = 0.0;
      for (int i = 0; i < kRays; ++i) {
        const Vec3 from{20'000.0 * Uniform(&random), 20'000.0 * Uniform(&random), 0.0};
        // Half of the rays about the sun, where the first scattering is.
        constexpr double kCone = 30.0 * kRadiansPerDegree;
        const Vec3 view = i % 2 == 0 ? About({0.0, 0.0, 1.0}, std::sqrt(Uniform(&random)), &random)
                                     : About(sun, std::cos(kCone * Uniform(&random)), &random);
        if (view.z < 0.01) continue;
        const double angle = std::acos(std::clamp(Dot(view, sun), -1.0, 1.0));
        const double density =
            0.5 * view.z / pi +
            (angle < kCone ? 0.5 / (kCone * 2.0 * pi * std::max(1e-7, std::sin(angle))) : 0.0);
        const LayerRay ray = MarchLayer(*field, higher, from, view, sun, true, 0.0);
        sum += (ray.first + scale * ray.higher) * view.z / density / kRays;
      }
      EXPECT_NEAR(sum / down, 1.0, 0.06) << kind << " " << elevation;
    }
  }
}

TEST(LayerMarch, LeavesHomogeneousLayersAsTheyAre) {
  const auto slab = FieldOf("kind=slab");
  const Vec3 sun = SouthernSun(40);
  EXPECT_EQ(MeanHigherScale(*slab, HigherOrders(CloudKind::kSlab, sun.z), sun, 0.3), 1.0);
}

}  // namespace
}  // namespace pleinair::clouds
