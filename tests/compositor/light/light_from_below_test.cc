// Tests what glossy virtual objects reflect from below the horizon.
#include <gtest/gtest.h>

#include <numbers>
#include <vector>

#include "compositor/light/light_solver.h"
#include "compositor/light/sun_transmittance_map.h"
#include "tests/compositor/light/light_scenes.h"

namespace pleinair::compositor {
namespace {

using testing::BoxModel;
using testing::Ground;
using testing::Object;
using testing::Phantom;
using testing::UniformDay;

constexpr double kSky = 5e3, kSun = 60e3;
const UniformDay kDay({kSky, kSky, kSky}, {kSun, kSun, kSun}, {0.6, 0.0, 0.8});
// On level, unoccluded ground.
const double kSkyLevel = kSky * std::numbers::pi, kLevel = kSkyLevel + 0.8 * kSun;
constexpr double kLand = 0.2;

PlacedModel Vase() { return Object(BoxModel({-0.1, -0.1, 0.2}, {0.1, 0.1, 0.6}, {})); }

double FromBelow(const std::vector<PlacedModel>& scene,
                 const SunTransmittanceMap& sun_transmittance = {},
                 const Mat3& marker_from_world = {}) {
  const auto solver = *LightSolver::Create(scene, {.rays_per_vertex = 1, .near_edge_m = 1.0});
  return solver->RadianceFromBelow(kDay, marker_from_world, sun_transmittance).g * std::numbers::pi;
}

TEST(RadianceFromBelow, IsWhatTheGroundReflects) {
  EXPECT_NEAR(FromBelow({Phantom(Ground(50.0, {0.4F, 0.4F, 0.4F})), Vase()}), 0.4 * kLevel,
              0.01 * kLevel);
}

TEST(RadianceFromBelow, KnowsTexturesByTheirMean) {
  auto paving = Ground(50.0, {0.8F, 0.8F, 0.8F});
  paving->meshes[0].uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  paving->materials[0].base_color_texture = 0;
  Image<std::uint8_t> half_black(2, 1, 3);
  for (int c = 0; c < 3; ++c) half_black(0, 0, c) = 255;
  paving->textures.push_back(half_black);
  EXPECT_NEAR(FromBelow({Phantom(paving), Vase()}), 0.4 * kLevel, 0.01 * kLevel);
}

TEST(RadianceFromBelow, DoesNotKnowTheColorOfHoles) {
  auto leaves = Ground(50.0, {0.8F, 0.8F, 0.8F});
  leaves->meshes[0].uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  leaves->materials[0].base_color_texture = 0;
  Image<std::uint8_t> white_beside_hole(2, 1, 4);
  for (int c = 0; c < 4; ++c) white_beside_hole(0, 0, c) = 255;
  leaves->textures.push_back(white_beside_hole);
  leaves->materials[0].alpha = Material::Alpha::kCutout;
  EXPECT_NEAR(FromBelow({Phantom(leaves), Vase()}), 0.8 * kLevel, 0.01 * kLevel);
  leaves->materials[0].alpha = Material::Alpha::kIgnored;
  EXPECT_NEAR(FromBelow({Phantom(leaves), Vase()}), 0.4 * kLevel, 0.01 * kLevel);
}

TEST(RadianceFromBelow, OfAYardInTheShadeOfAWallLacksTheSun) {
  // The wall also occludes part of the sky and reflects a little light.
  const double shaded =
      FromBelow({Phantom(Ground(4.0, {0.4F, 0.4F, 0.4F})),
                 Phantom(BoxModel({4.0, -50.0, 0.0}, {4.2, 50.0, 12.0}, {})), Vase()});
  EXPECT_LT(shaded, 0.4 * kSkyLevel + 0.1 * kLand * kLevel);
  EXPECT_GT(shaded, 0.5 * 0.4 * kSkyLevel);
}

TEST(RadianceFromBelow, UnderTreesHasTheSunThatTheyLeave) {
  const auto map = BuildSunTransmittanceMap(
      kDay.ToSun().xyz, std::vector<SunlitSample>{{{0.0, 0.0, 0.0}, 0.25, 0.1}});
  EXPECT_NEAR(FromBelow({Phantom(Ground(50.0, {0.4F, 0.4F, 0.4F})), Vase()}, map),
              0.4 * (kSkyLevel + 0.25 * 0.8 * kSun), 0.01 * kLevel);
}

TEST(RadianceFromBelow, IsTheLandsWithoutPhantomsWhateverTheObject) {
  EXPECT_NEAR(FromBelow({Vase()}), kLand * kLevel, 0.01 * kLevel);
  EXPECT_NEAR(FromBelow({Object(Ground(0.5, {0.9F, 0.9F, 0.9F}))}), kLand * kLevel, 0.01 * kLevel);
}

TEST(RadianceFromBelow, ComesFromTheGroundForAMarkerOnAWall) {
  // y is up; the wall is the plane z = 0.
  const Mat3 upright{1, 0, 0, 0, 0, 1, 0, -1, 0};
  const PlacedModel wall = Phantom(BoxModel({-0.5, -1.0, -0.2}, {0.5, 1.0, 0.0}, {1, 1, 1}));
  const PlacedModel ground =
      Phantom(BoxModel({-50.0, -1.1, -50.0}, {50.0, -1.0, 50.0}, {0.4F, 0.4F, 0.4F}));
  EXPECT_NEAR(FromBelow({wall, ground, Vase()}, {}, upright), 0.4 * kLevel, 0.15 * kLevel);
}

TEST(RadianceFromBelow, IsBlackWithoutAnObject) {
  EXPECT_EQ(FromBelow({Phantom(Ground(1.0, {0.4F, 0.4F, 0.4F}))}), 0.0);
}

}  // namespace
}  // namespace pleinair::compositor
