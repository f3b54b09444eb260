// What is drawn once models have moved or another light was made.

#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "base/srgb.h"
#include "compositor/composer.h"
#include "tests/compositor/composer_scene.h"

namespace pleinair::compositor {
namespace {

TEST(Composer, ShadesAMovedModelWhereItStandsNow) {
  const auto solver = LightSolver::Create({kCube}, {.rays_per_vertex = 64});
  auto composer = Composer::Create(kCamera, {kCube}, {});
  ASSERT_TRUE(solver.has_value());
  ASSERT_TRUE(composer.has_value());
  const SouthernSun light;
  ASSERT_TRUE((*composer)->SetLight((*solver)->Solve(light, Mat3{}), light, Mat3{},
                                    (*solver)->RadianceFromBelow(light, Mat3{})));
  const RgbImage picture = EvenPicture(77);
  ASSERT_TRUE((*composer)->Compose(picture.view(), kFromAbove, {kGain, kGain, kGain}));
  // Half as large, a quarter turned and 0.4 m aside.
  (*composer)->MoveModel(0, {{0, -0.5, 0, 0.5, 0, 0, 0, 0, 0.5}}, {0.4, 0.2, 0});
  const auto moved = (*composer)->Compose(picture.view(), kFromAbove, {kGain, kGain, kGain});
  ASSERT_TRUE(moved.has_value());
  EXPECT_EQ(SeenAt(*moved, {0, 0, 0.3}), LinearFromSrgb8()[77]);
  EXPECT_NEAR(SeenAt(*moved, {0.4, 0.2, 0.15}), Level(0.5), 0.02);
  EXPECT_NEAR(SeenAt(*moved, {0.46, 0.26, 0.15}), Level(0.5), 0.02) << "near its corner";
  EXPECT_EQ(SeenAt(*moved, {0.5, 0.2, 0.15}), LinearFromSrgb8()[77]);
}

TEST(Composer, DrawsAFurtherLightAsIfItWereTheFirst) {
  using Bytes = std::vector<std::uint8_t>;
  const std::vector<PlacedModel> scene{kGround, kCube};
  const auto solver = LightSolver::Create(scene, {.rays_per_vertex = 64});
  ASSERT_TRUE(solver.has_value());
  const SouthernSun sunny, overcast(0.0);
  const RgbImage picture = EvenPicture(120);
  const auto compose = [&](Composer* composer) -> Bytes {
    const auto composed = composer->Compose(picture.view(), kFromAbove, {kGain, kGain, kGain});
    EXPECT_TRUE(composed.has_value());
    return {composed->data(), composed->data() + composed->size()};
  };
  const auto light = [&](Composer* composer, const SouthernSun& day) {
    EXPECT_TRUE(composer->SetLight((*solver)->Solve(day, Mat3{}), day, Mat3{},
                                   (*solver)->RadianceFromBelow(day, Mat3{})));
    return compose(composer);
  };
  const auto composer = Composer::Create(kCamera, scene, {});
  const auto other = Composer::Create(kCamera, scene, {});
  ASSERT_TRUE(composer.has_value() && other.has_value());
  const Bytes in_sun = light(composer->get(), sunny);
  (*composer)->MoveModel(1, Mat3{}, {0.3, 0.0, 0.0});
  EXPECT_NE(compose(composer->get()), in_sun);
  // A light puts the models back to where it was made.
  const Bytes under_clouds = light(composer->get(), overcast);
  EXPECT_NE(under_clouds, in_sun);
  EXPECT_EQ(under_clouds, light(other->get(), overcast));
  EXPECT_EQ(light(composer->get(), sunny), in_sun);
}

TEST(Composer, DrawsTheSameWhereItKnowsWhatPhantomsLeaveOfTheSun) {
  // A wall's shadow runs over the ground beside the cube's.
  const PlacedModel wall = Place(MakeBox({-0.9, -0.5, 0}, {-0.4, -0.45, 0.6}, 0.5F), true);
  const std::vector<PlacedModel> scene{kGround, wall, kCube};
  const auto solver = LightSolver::Create(scene, {.rays_per_vertex = 64});
  const auto composer = Composer::Create(kCamera, scene, {});
  ASSERT_TRUE(solver.has_value() && composer.has_value());
  (*composer)->LookForShade(false);
  const SouthernSun day;
  const auto compose = [&](const std::vector<LitMesh>& lit) {
    EXPECT_TRUE((*composer)->SetLight(lit, day, Mat3{}, {}));
    auto composed =
        (*composer)->Compose(EvenPicture(200).view(), kFromAbove, {kGain, kGain, kGain});
    EXPECT_TRUE(composed.has_value());
    return *std::move(composed);
  };
  std::vector<LitMesh> lit = (*solver)->Solve(day, Mat3{});
  const RgbImage known = compose(lit);
  for (LitMesh& mesh : lit) mesh.sun_reach.clear();
  const RgbImage looked_up = compose(lit);
  int changed = 0, most = 0;
  for (std::size_t i = 0; i < known.size(); ++i) {
    most = std::max(most, std::abs(known.data()[i] - looked_up.data()[i]));
    changed += looked_up.data()[i] < 200 ? 1 : 0;
  }
  EXPECT_GT(changed, 10'000) << "the sky's light changes far around the cube";
  EXPECT_LE(most, 2) << "but for the wall's half-light";
}

TEST(Composer, MovesTheShadowOfAModelThatTurnsWithinItsBox) {
  // Two posts on a square's diagonal, turned to the other one.
  Model posts = MakeBox({-0.35, -0.35, 0.001}, {-0.25, -0.25, 0.2}, 0.5F);
  posts.meshes.push_back(MakeBox({0.25, 0.25, 0.001}, {0.35, 0.35, 0.2}, 0.5F).meshes[0]);
  const std::vector<PlacedModel> scene{kGround, Place(posts, false)};
  const auto composer = ComposerInTheSun(scene);
  const auto shares = [&] {
    const auto composed =
        composer->Compose(EvenPicture(200).view(), kFromAbove, {kGain, kGain, kGain});
    EXPECT_TRUE(composed);
    const double before = LinearFromSrgb8()[200];
    return std::pair{SeenAt(*composed, {-0.3, -0.16, 0}) / before,
                     SeenAt(*composed, {0.3, -0.16, 0}) / before};
  };
  const auto [shaded, lit] = shares();
  EXPECT_LT(shaded, 0.4);
  EXPECT_GT(lit, 0.9);
  composer->MoveModel(1, {{0, -1, 0, 1, 0, 0, 0, 0, 1}}, {0, 0, 0});
  const auto [lit_now, shaded_now] = shares();
  EXPECT_LT(shaded_now, 0.4);
  EXPECT_GT(lit_now, 0.7) << "its light stays until it is made anew";
}
}  // namespace
}  // namespace pleinair::compositor
