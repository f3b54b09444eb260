// Tests drawing after models have moved or the light has changed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "base/srgb.h"
#include "compositor/composer.h"
#include "compositor/light/scaled_sky.h"
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
  ASSERT_TRUE((*composer)->Compose(picture.view(), kFromAbove,
                                   {kExposureScale, kExposureScale, kExposureScale}));
  // Half the size, a quarter turn, shifted by 0.4 m.
  (*composer)->MoveModel(0, {{0, -0.5, 0, 0.5, 0, 0, 0, 0, 0.5}}, {0.4, 0.2, 0});
  const auto moved = (*composer)->Compose(picture.view(), kFromAbove,
                                          {kExposureScale, kExposureScale, kExposureScale});
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
    const auto composed = composer->Compose(picture.view(), kFromAbove,
                                            {kExposureScale, kExposureScale, kExposureScale});
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
  // A new light resets the models to their positions at its computation.
  const Bytes under_clouds = light(composer->get(), overcast);
  EXPECT_NE(under_clouds, in_sun);
  EXPECT_EQ(under_clouds, light(other->get(), overcast));
  EXPECT_EQ(light(composer->get(), sunny), in_sun);
}

TEST(Composer, KnowsTheColorThatGroundIsGivenLate) {
  const std::vector<PlacedModel> assumed{Place(MakeBox({-4, -4, 0}, {4, 4, 0}, 0.33F), true),
                                         kCube};
  const std::vector<PlacedModel> measured{Place(MakeBox({-4, -4, 0}, {4, 4, 0}, 0.12F), true),
                                          kCube};
  const auto late = Composer::Create(kCamera, assumed, {});
  const auto early = Composer::Create(kCamera, measured, {});
  ASSERT_TRUE(late.has_value() && early.has_value());
  const RgbImage asphalt = EvenPicture(87);  // Level(0.12), in the sun.
  const double before = LinearFromSrgb8()[87];
  ASSERT_NEAR(before, Level(0.12), 0.002);
  const auto compose = [&](Composer* composer, const std::vector<PlacedModel>& scene) {
    const SouthernSun day;
    const auto solver = LightSolver::Create(scene, {.rays_per_vertex = 64});
    EXPECT_TRUE(composer->SetLight(solver.value()->Solve(day, Mat3{}), day, Mat3{}, {}));
    auto composed = composer->Compose(asphalt.view(), kFromAbove,
                                      {kExposureScale, kExposureScale, kExposureScale});
    EXPECT_TRUE(composed.has_value());
    return *std::move(composed);
  };
  const Vec3 in_shadow{0, 0.3, 0};
  EXPECT_GT(SeenAt(compose(late->get(), assumed), in_shadow), 0.5 * before)
      << "lighter ground would be shaded already";
  const RgbImage now = compose(late->get(), measured);
  EXPECT_LT(SeenAt(now, in_shadow), 0.4 * before);
  const RgbImage known = compose(early->get(), measured);
  EXPECT_TRUE(std::equal(now.data(), now.data() + now.size(), known.data()));
}

/// A wall's shadow on the ground beside the cube's.
class SunReachOfWallTest : public ::testing::Test {
 protected:
  struct Pictures {
    RgbImage known, looked_up, misled;
  };

  /// Images composed with the light's sun visibility, without it, and with a wrong one that marks
  /// fully lit triangles as unlit.
  Pictures Compose(const sky::SkyModel& day) {
    const auto solver = LightSolver::Create(scene_, {.rays_per_vertex = 64});
    const auto composer = Composer::Create(kCamera, scene_, {});
    EXPECT_TRUE(solver.has_value() && composer.has_value());
    (*composer)->AssumeUnmodelledShadows(false);
    const auto compose = [&](const std::vector<LitMesh>& lit) {
      EXPECT_TRUE((*composer)->SetLight(lit, day, Mat3{}, {}));
      auto composed = (*composer)->Compose(EvenPicture(200).view(), kFromAbove,
                                           {kExposureScale, kExposureScale, kExposureScale});
      EXPECT_TRUE(composed.has_value());
      return *std::move(composed);
    };
    std::vector<LitMesh> lit = (*solver)->Solve(day, Mat3{});
    Pictures pictures;
    pictures.known = compose(lit);
    for (LitMesh& mesh : lit) {
      for (SunVisibility& reach : mesh.sunlight.by_triangle) {
        if (reach == SunVisibility::kAll) reach = SunVisibility::kNone;
      }
    }
    pictures.misled = compose(lit);
    for (LitMesh& mesh : lit) mesh.sunlight.by_triangle.clear();
    pictures.looked_up = compose(lit);
    return pictures;
  }

  static int MaxDifference(const RgbImage& a, const RgbImage& b) {
    int most = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      most = std::max(most, std::abs(a.data()[i] - b.data()[i]));
    }
    return most;
  }

  const PlacedModel wall_ = Place(MakeBox({-0.9, -0.5, 0}, {-0.4, -0.45, 0.6}, 0.5F), true);
  const std::vector<PlacedModel> scene_{kGround, wall_, kCube};
};

TEST_F(SunReachOfWallTest, IsDrawnAsShadowMapsWouldHaveIt) {
  const Pictures pictures = Compose(SouthernSun());
  const auto changed =
      std::count_if(pictures.known.data(), pictures.known.data() + pictures.known.size(),
                    [](std::uint8_t code) { return code < 200; });
  EXPECT_GT(changed, 10'000) << "the sky's light changes far around the cube";
  EXPECT_LE(MaxDifference(pictures.known, pictures.looked_up), 2) << "but for half-light";
  EXPECT_GT(MaxDifference(pictures.misled, pictures.looked_up), 5) << "it is what is drawn";
}

/// An overcast sky in air that transmits half of the light over three metres.
class OvercastInHaze : public SouthernSun {
 public:
  OvercastInHaze() : SouthernSun(0.0) {}
  AirBetween AirTo(Direction<World>, Metres distance) const override {
    const double left = std::exp2(-distance.value() / 3.0);
    return {{left, left, left}, LinearRgb{1.0, 1.0, 1.0} * (kAirlight * (1.0 - left))};
  }
  static constexpr double kAirlight = 6000.0;
};

TEST(Composer, LeavesTheAirBeforeAContactShadowFromTheFirstFrameOn) {
  const std::vector<PlacedModel> scene{kGround, kCube};
  const auto solver = LightSolver::Create(scene, {.rays_per_vertex = 256});
  const auto composer = Composer::Create(kCamera, scene, {});
  ASSERT_TRUE(solver.has_value() && composer.has_value());
  const RgbImage picture = EvenPicture(150);
  const SouthernSun overcast(0.0);
  const OvercastInHaze needs_airlight;
  const auto lit = (*solver)->Solve(overcast, Mat3{});
  const auto compose = [&](const sky::SkyModel& day) {
    EXPECT_TRUE((*composer)->SetLight(lit, day, Mat3{}, {}));
    auto composed = (*composer)->Compose(picture.view(), kFromAbove,
                                         {kExposureScale, kExposureScale, kExposureScale});
    EXPECT_TRUE(composed.has_value());
    return *std::move(composed);
  };
  const RgbImage in_haze = compose(needs_airlight);
  const auto again = (*composer)->Compose(picture.view(), kFromAbove,
                                          {kExposureScale, kExposureScale, kExposureScale});
  ASSERT_TRUE(again.has_value());
  EXPECT_TRUE(std::equal(in_haze.data(), in_haze.data() + in_haze.size(), again->data()));
  // In clear air the image shows the ratio. Here half of the light is airlight.
  const RgbImage clear = compose(overcast);
  const double before = LinearFromSrgb8()[150],
               air = kExposureScale * OvercastInHaze::kAirlight / 2;
  ASSERT_LT(air, before);
  for (const Vec3& beside : {Vec3{-0.19, 0, 0}, Vec3{0.19, 0.05, 0}, Vec3{0, -0.2, 0}}) {
    const double ratio = SeenAt(clear, beside) / before;
    const double kept = (1.0 - ratio) * air;
    EXPECT_GT(kept, 0.012);
    // A pixel value step is 0.004 there. The airlight is that of the distance to the centre.
    EXPECT_NEAR(SeenAt(in_haze, beside) - SeenAt(clear, beside), kept, 0.006);
  }
}

TEST(Composer, BelievesNoDarkCornerOfAPhantom) {
  // Hardly any light reaches one corner of a triangle, and the object takes half of it. At the
  // other corners it takes a twentieth.
  const PlacedModel floor = Place(MakeBox({-1, -1, 0}, {1, 1, 0}, 0.3F), true);
  const std::vector<PlacedModel> scene{floor, kCube};
  const auto solver = LightSolver::Create(scene, {.rays_per_vertex = 16, .near_edge_m = 0.5});
  const auto composer = Composer::Create(kCamera, scene, {});
  ASSERT_TRUE(solver.has_value() && composer.has_value());
  const SouthernSun overcast(0.0);
  std::vector<LitMesh> lit = (*solver)->Solve(overcast, Mat3{});
  for (LitMesh& mesh : lit) {
    if (!mesh.is_phantom) continue;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const bool dark = mesh.positions[i][0] > 0.6F && mesh.positions[i][1] > 0.6F;
      const float light = dark ? 0.0F : 20000.0F;
      mesh.ambient_without[i] = {light, light, light};
      mesh.ambient_with[i] = {0.95F * light, 0.95F * light, 0.95F * light};
    }
  }
  ASSERT_TRUE((*composer)->SetLight(lit, overcast, Mat3{}, {}));
  const auto composed = (*composer)->Compose(EvenPicture(150).view(), kFromAbove,
                                             {kExposureScale, kExposureScale, kExposureScale});
  ASSERT_TRUE(composed.has_value());
  for (int twentieth = 10; twentieth < 18; ++twentieth) {
    const double at = twentieth / 20.0;
    EXPECT_NEAR(SeenAt(*composed, {at, at, 0}) / LinearFromSrgb8()[150], 0.95, 0.01) << at;
  }
}

TEST(Composer, MixesSunAndSkyAsIfTheyHadBeenSolvedSo) {
  const PlacedModel cube = Place(MakeBox({-0.15, -0.15, 0.001}, {0.15, 0.15, 0.3}, 0.5F), false);
  const std::vector<PlacedModel> scene{kGround, cube};
  const auto solver = LightSolver::Create(scene, {.rays_per_vertex = 64});
  ASSERT_TRUE(solver.has_value());
  const SouthernSun day;
  const std::vector<LitMesh> lit = (*solver)->Solve(day, Mat3{});
  const auto draw = [&](const sky::SkyModel& lit_by, const std::vector<LitMesh>& meshes,
                        const LightMix& mix) {
    const auto composer = Composer::Create(kCamera, scene, {});
    EXPECT_TRUE(composer.has_value());
    EXPECT_TRUE((*composer)->SetLight(meshes, lit_by, Mat3{}, {}));
    EXPECT_TRUE((*composer)->SetLightMix(meshes, mix));
    auto composed = (*composer)->Compose(EvenPicture(120).view(), kFromAbove,
                                         {kExposureScale, kExposureScale, kExposureScale});
    EXPECT_TRUE(composed.has_value());
    return *std::move(composed);
  };
  for (const LightMix& mix :
       {LightMix{{0.2, 0.3, 0.4}, {1.2, 1.1, 1.3}}, LightMix{{0, 0, 0}, {1, 1, 1}}}) {
    const ScaledSky mixed(day, mix.sky, mix.sun);
    const RgbImage as_mixed = draw(day, lit, mix);
    const RgbImage as_solved = draw(mixed, (*solver)->Solve(mixed, Mat3{}), {});
    int other = 0;
    for (std::size_t i = 0; i < as_mixed.size(); ++i) {
      const int difference = std::abs(as_mixed.data()[i] - as_solved.data()[i]);
      EXPECT_LE(difference, 1);
      other += difference;
    }
    EXPECT_LT(other, static_cast<int>(as_mixed.size() / 1000));
    EXPECT_NE(SeenAt(as_mixed, {0, 0, 0.3}), SeenAt(draw(day, lit, {}), {0, 0, 0.3}));
  }
}

TEST(Composer, MovesTheShadowOfAModelThatTurnsWithinItsBox) {
  // Two posts on one diagonal of a square, then turned to the other.
  Model posts = MakeBox({-0.35, -0.35, 0.001}, {-0.25, -0.25, 0.2}, 0.5F);
  posts.meshes.push_back(MakeBox({0.25, 0.25, 0.001}, {0.35, 0.35, 0.2}, 0.5F).meshes[0]);
  const std::vector<PlacedModel> scene{kGround, Place(posts, false)};
  const auto composer = ComposerInTheSun(scene);
  const auto shares = [&] {
    const auto composed = composer->Compose(EvenPicture(200).view(), kFromAbove,
                                            {kExposureScale, kExposureScale, kExposureScale});
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
