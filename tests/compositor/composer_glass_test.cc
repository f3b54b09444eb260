// Tests glass and other blended surfaces.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/srgb.h"
#include "compositor/composer.h"
#include "tests/compositor/composer_scene.h"

namespace pleinair::compositor {
namespace {

/// A black level pane that casts no shadow.
Model BlackPane(float opacity, Vec3 low, Vec3 high) {
  Model pane = MakeBox(low, high, 0.0F);
  pane.materials[0].opacity = opacity;
  pane.materials[0].alpha = Material::Alpha::kBlended;
  pane.meshes[0].role = MeshRole::kRenderOnly;
  return pane;
}

TEST(Composer, ShowsThroughGlassWhatLiesBehind) {
  const auto pane = [](float opacity, float height, Material::Alpha alpha) {
    Model glass = MakeBox({-0.5, -0.5, height}, {0.5, 0.5, height}, 0.0F);
    glass.materials[0].opacity = opacity;
    glass.materials[0].alpha = alpha;
    return Place(glass, false);
  };
  using Alpha = Material::Alpha;
  for (const float opacity : {0.1F, 0.3F, 0.5F, 0.9F}) {
    EXPECT_NEAR(LetThrough({pane(opacity, 0.1F, Alpha::kBlended)}), 1.0F - opacity, 0.02);
  }
  // The samples of the first pane must not hide the second.
  const double both =
      LetThrough({pane(0.5F, 0.1F, Alpha::kBlended), pane(0.5F, 0.3F, Alpha::kBlended)});
  EXPECT_NEAR(both, 0.25, 0.03);
  EXPECT_EQ(LetThrough({pane(0.3F, 0.1F, Alpha::kIgnored)}), 0.0);
  EXPECT_EQ(LetThrough({pane(0.3F, 0.1F, Alpha::kCutout)}), 1.0);
}

TEST(Composer, DrawsGlassWithoutAPattern) {
  Model glass = MakeBox({-0.5, -0.5, 0.1}, {0.5, 0.5, 0.1}, 0.0F);
  glass.materials[0].opacity = 0.3F;
  glass.materials[0].alpha = Material::Alpha::kBlended;
  constexpr std::uint8_t kBehind = 200;
  const RgbImage composed = Compose({Place(glass, false)}, EvenPicture(kBehind));
  const int middle_x = composed.width() / 2, middle_y = composed.height() / 2;
  const double expected = 0.7 * LinearFromSrgb8()[kBehind];
  for (int y = middle_y - 12; y < middle_y + 12; ++y) {
    for (int x = middle_x - 12; x < middle_x + 12; ++x) {
      EXPECT_NEAR(LinearFromSrgb8()[composed(x, y, 1)], expected, 0.01) << x << ", " << y;
    }
  }
}

TEST(Composer, DrawsWhatCastsNoShadow) {
  // Thin glass as in a model, alone in the scene.
  Model pane = MakeBox({-0.5, -0.5, 0.1}, {0.5, 0.5, 0.1}, 0.0F);
  pane.materials[0].opacity = 0.3F;
  pane.materials[0].alpha = Material::Alpha::kBlended;
  pane.meshes[0].role = MeshRole::kRenderOnly;
  EXPECT_NEAR(LetThrough({Place(pane, false)}), 0.7, 0.02);
}

TEST(Composer, ShowsAShadowThroughGlassAsDarkAsBesideIt) {
  // The cube's shadow lies north of it, below three panes. In fog, a black pane has the airlight
  // before it.
  const std::array<float, 3> opacities{0.1F, 0.5F, 0.9F};
  const auto place_of = [](std::size_t pane) {
    return Vec3{0.1 * static_cast<double>(pane) - 0.1, 0.3, 0.0};
  };
  const auto compose = [&](const std::array<const SouthernSun*, 2>& days, bool with_panes) {
    std::vector<PlacedModel> scene{kGround, kCube};
    for (std::size_t i = 0; with_panes && i < opacities.size(); ++i) {
      const double x = place_of(i).x;
      scene.push_back(
          Place(BlackPane(opacities[i], {x - 0.049, 0.1, 0.4}, {x + 0.049, 0.5, 0.4}), false));
    }
    const auto solver = LightSolver::Create(scene, {.rays_per_vertex = 64});
    const auto composer = Composer::Create(kCamera, scene, {});
    composer.value()->AssumeUnmodelledShadows(false);
    const auto lit = solver.value()->Solve(*days[0], Mat3{});
    std::array<RgbImage, 2> images;
    for (std::size_t i = 0; i < days.size(); ++i) {
      EXPECT_TRUE(composer.value()->SetLight(lit, *days[i], Mat3{}, {1, 1, 1}));
      images[i] = composer.value()
                      ->Compose(EvenPicture(200).view(), kFromAbove,
                                {kExposureScale, kExposureScale, kExposureScale})
                      .value();
    }
    return images;
  };
  const SouthernSun clear;
  const HazySouthernSun hazy(8.0);
  const double air = kExposureScale * HazySouthernSun::kAirlight * (1.0 - std::exp2(-2.6 / 8.0));
  const auto beside = compose({&clear, &hazy}, false), through = compose({&clear, &hazy}, true);
  for (const bool in_haze : {false, true}) {
    const std::size_t day = in_haze ? 1 : 0;
    for (std::size_t i = 0; i < opacities.size(); ++i) {
      const double shadow = SeenAt(beside[day], place_of(i));
      EXPECT_LT(shadow, 0.4 * LinearFromSrgb8()[200]);
      EXPECT_NEAR(SeenAt(through[day], place_of(i)),
                  (1.0 - opacities[i]) * shadow + (in_haze ? opacities[i] * air : 0.0), 0.006)
          << opacities[i] << (in_haze ? " in haze" : "");
    }
  }
}

TEST(Composer, ShowsTwoPanesWhateverLiesBetween) {
  // As surfaces of the scene, the panes have the numbers 0 and 3.
  const PlacedModel cube = Place(MakeBox({-0.9, -0.9, 0.1}, {-0.8, -0.8, 0.2}, 0.5F), false);
  const auto pane = [](double z) { return Place(BlackPane(0.5F, {-1, -1, z}, {1, 1, z}), false); };
  EXPECT_NEAR(LetThrough({pane(0.3), cube, pane(0.4)}), 0.25, 0.01);
}

TEST(Composer, DrawsNoSeamWhereAPaneIsFolded) {
  // A roof whose ridge crosses the pixels at a slant. Its two sides are pieces of one pane.
  Model roof = BlackPane(0.9F, {-0.5, -0.5, 0.1}, {0.5, 0.5, 0.1});
  Mesh& mesh = roof.meshes[0];
  mesh.positions.clear();
  mesh.normals.clear();
  mesh.indices.clear();
  for (const float side : {-1.0F, 1.0F}) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const auto& [x, y, z] : {std::array<float, 3>{0.5F * side, -0.5F, 0.1F},
                                  {0.5F * side, 0.5F, 0.1F},
                                  {0.05F, 0.5F, 0.5F},
                                  {-0.05F, -0.5F, 0.5F}}) {
      mesh.positions.push_back({x, y, z});
      mesh.normals.push_back({0.62F * side, 0.0F, 0.78F});
    }
    for (const std::uint32_t i : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.indices.push_back(first + i);
  }
  const RgbImage composed = Compose({Place(roof, false)}, EvenPicture(200));
  const double expected = 0.1 * LinearFromSrgb8()[200];
  for (int y = 100; y < 140; ++y) {
    for (int x = 140; x < 180; ++x) {
      EXPECT_NEAR(LinearFromSrgb8()[composed(x, y, 1)], expected, 0.01) << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace pleinair::compositor
