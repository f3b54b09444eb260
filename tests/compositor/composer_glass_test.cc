// Tests glass and other blended surfaces.
#include <gtest/gtest.h>

#include <cmath>
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

/// The southern sun in air that transmits 2^(-d / 8 m) over a distance of d.
class HazySunOverGlass : public SouthernSun {
 public:
  AirBetween AirTo(Direction<World>, Metres distance) const override {
    const double left = std::exp2(-distance.value() / 8.0);
    return {{left, left, left}, LinearRgb{1.0, 1.0, 1.0} * (kAirlight * (1.0 - left))};
  }
  static constexpr double kAirlight = 6000.0;
};

TEST(Composer, ShowsAShadowThroughGlassAsDarkAsBesideIt) {
  // The cube's shadow lies north of it. In fog, the black pane has the airlight before it.
  const Vec3 in_shadow{0, 0.3, 0};
  const SouthernSun clear;
  const HazySunOverGlass hazy;
  const auto seen = [&](const std::vector<PlacedModel>& scene, const SouthernSun& day) {
    const auto solver = LightSolver::Create(scene, {.rays_per_vertex = 64});
    const auto composer = Composer::Create(kCamera, scene, {});
    EXPECT_TRUE(composer.value()->SetLight(solver.value()->Solve(day, Mat3{}), day, Mat3{},
                                           solver.value()->RadianceFromBelow(day, Mat3{})));
    composer.value()->AssumeUnmodelledShadows(false);
    const auto composed = composer.value()->Compose(
        EvenPicture(200).view(), kFromAbove, {kExposureScale, kExposureScale, kExposureScale});
    return SeenAt(composed.value(), in_shadow);
  };
  const double lit = LinearFromSrgb8()[200];
  const double before_pane =
      kExposureScale * HazySunOverGlass::kAirlight * (1.0 - std::exp2(-2.5 / 8.0));
  const double shadow = seen({kGround, kCube}, clear), hazy_shadow = seen({kGround, kCube}, hazy);
  ASSERT_LT(shadow, 0.3 * lit);
  ASSERT_GT(hazy_shadow, shadow + 0.02);
  for (const float opacity : {0.1F, 0.5F, 0.9F}) {
    const PlacedModel pane = Place(BlackPane(opacity, {-0.5, 0.2, 0.5}, {0.5, 0.5, 0.5}), false);
    EXPECT_NEAR(seen({kGround, kCube, pane}, clear), (1.0 - opacity) * shadow, 0.006) << opacity;
    EXPECT_NEAR(seen({kGround, kCube, pane}, hazy),
                (1.0 - opacity) * hazy_shadow + opacity * before_pane, 0.006)
        << opacity;
  }
}

}  // namespace
}  // namespace pleinair::compositor
