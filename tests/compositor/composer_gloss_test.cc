// Tests reflections of metals, coats and thin sheets.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "compositor/composer.h"
#include "tests/compositor/composer_scene.h"

namespace pleinair::compositor {
namespace {

TEST(Composer, MirrorsTheSkyInPolishedMetal) {
  Model plate = MakeBox({-0.5, -0.5, 0.1}, {0.5, 0.5, 0.1}, 0.7F);
  plate.materials[0].metallic = 1.0F;
  plate.materials[0].roughness = 0.1F;
  const RgbImage composed = Compose({Place(plate, false)}, EvenPicture(0));
  // The sun, 45° off, is reflected elsewhere.
  EXPECT_NEAR(SeenAt(composed, {0, 0, 0.1}), kExposureScale * 0.7 * kSkyLux * std::numbers::inv_pi,
              0.01);
}

TEST(Composer, TellsACoatsRoughnessFromItsReflectance) {
  // A black plate shows only its coat. The sun, 45° off, is reflected elsewhere unless the coat is
  // rough.
  const auto seen = [](float roughness, float f0, double sun_lux) {
    Model plate = MakeBox({-0.5, -0.5, 0.1}, {0.5, 0.5, 0.1}, 0.0F);
    plate.materials[0].roughness = roughness;
    plate.materials[0].coat.f0 = f0;
    return SeenAt(Compose({Place(plate, false)}, EvenPicture(0), kCamera, sun_lux), {0, 0, 0.1});
  };
  EXPECT_NEAR(seen(0.1F, 0.5F, kSunLux), 0.5 * kExposureScale * kSkyLux * std::numbers::inv_pi,
              0.01);
  EXPECT_GT(seen(0.5F, 0.1F, kSunLux), seen(0.5F, 0.1F, 0.0) + 0.02);
}

/// A square of 1 m around the marker's centre that faces `normal`, with either winding.
Model SquareFacing(Vec3 normal, float albedo, bool turned) {
  Model square = MakeBox({-0.5, -0.5, 0}, {0.5, 0.5, 0}, albedo);
  const Vec3 x{1, 0, 0}, y = Cross(normal, x);
  Mesh& mesh = square.meshes[0];
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const auto [u, v, w] = mesh.positions[i];
    const Vec3 at = x * u + y * v;
    mesh.positions[i] = {static_cast<float>(at.x), static_cast<float>(at.y),
                         static_cast<float>(at.z)};
    const Vec3 facing = turned ? -normal : normal;
    mesh.normals[i] = {static_cast<float>(facing.x), static_cast<float>(facing.y),
                       static_cast<float>(facing.z)};
  }
  if (turned) std::reverse(mesh.indices.begin(), mesh.indices.end());
  return square;
}

TEST(Composer, LightsAThinSheetsFarSideByTheSkyAlone) {
  // The sun is 8° behind the visible side.
  const Vec3 normal{0.0, 0.8, 0.6};
  constexpr double kAlbedo = 0.6, kSkySeen = 0.8, kLandAlbedo = 0.2;
  const double land = kLandAlbedo * (kSkyLux + kSunLux * std::numbers::sqrt2 / 2);
  const double expected = kExposureScale * kAlbedo * std::numbers::inv_pi *
                          (kSkySeen * kSkyLux + (1 - kSkySeen) * land);
  for (const bool turned : {false, true}) {
    const Model sheet = SquareFacing(normal, kAlbedo, turned);
    EXPECT_NEAR(SeenAt(Compose({Place(sheet, false)}, EvenPicture(0)), {0, 0, 0}), expected,
                0.03 * expected)
        << turned;
  }
}

TEST(Composer, ShowsTheSunsHighlightAsTheMicrofacetModelHasIt) {
  // A black coat. Its normal bisects the directions to the sun, 45° high in the south, and to the
  // eye above.
  const double c = std::cos(std::numbers::pi / 8);
  Model plate = SquareFacing({0.0, -std::sin(std::numbers::pi / 8), c}, 0.0F, false);
  constexpr double kF0 = 0.04, kRoughness = 0.5, kAlpha2 = 0.0625;
  plate.materials[0].roughness = kRoughness;
  plate.materials[0].coat.f0 = kF0;
  const auto seen = [&](double sun_lux) {
    return SeenAt(Compose({Place(plate, false)}, EvenPicture(0), kCamera, sun_lux), {0, 0, 0});
  };
  // Walter et al. 2007, Eq. (33) at the normal; Heitz 2014, Eq. (99); Schlick 1994.
  const double distribution = 1.0 / (std::numbers::pi * kAlpha2);
  const double visibility = 0.25 / (c * std::sqrt(c * c * (1 - kAlpha2) + kAlpha2));
  const double fresnel = kF0 + (1 - kF0) * std::pow(1 - c, 5);
  const double expected = kExposureScale * kSunLux * c * distribution * visibility * fresnel;
  EXPECT_NEAR(seen(kSunLux) - seen(0.0), expected, 0.03 * expected);
}

TEST(Composer, AddsACoatToWhatItLeavesOfTheColor) {
  const auto seen = [](float f0, float left) {
    Model plate = MakeBox({-0.5, -0.5, 0.1}, {0.5, 0.5, 0.1}, 0.4F);
    plate.materials[0].roughness = 0.1F;
    plate.materials[0].coat.f0 = f0;
    plate.materials[0].coat.base_share = left;
    return SeenAt(Compose({Place(plate, false)}, EvenPicture(0)), {0, 0, 0.1});
  };
  const double bare = seen(0.0F, 1.0F);
  const double coat = 0.1 * kExposureScale * kSkyLux * std::numbers::inv_pi;
  EXPECT_NEAR(seen(0.1F, 1.0F), bare + coat, 0.006);
  EXPECT_NEAR(seen(0.1F, 0.9F), 0.9 * bare + coat, 0.006);
}
}  // namespace
}  // namespace pleinair::compositor
