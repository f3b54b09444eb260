// Tests composed leaves: light from behind, gloss, and the colors of sun and sky.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "compositor/composer.h"
#include "compositor/models/leaf_material.h"
#include "tests/compositor/composer_scene.h"

namespace pleinair::compositor {
namespace {

constexpr double kRadiansOfTilt = 1.2;
const Vec3 kNormal{0.0, std::sin(kRadiansOfTilt), std::cos(kRadiansOfTilt)};
constexpr Vec3 kCentre{0.0, 0.0, 1.0};

/// A square of 1 m whose upper side faces north: away from the sun, and to the camera.
Model Panel(float reflectance, float transmittance) {
  Model panel = MakeBox({-0.5, -0.5, 0.0}, {0.5, 0.5, 0.0}, reflectance);
  for (auto& [x, y, z] : panel.meshes[0].positions) {
    const float across = y;
    y = across * static_cast<float>(kNormal.z);
    z = static_cast<float>(kCentre.z) - across * static_cast<float>(kNormal.y);
  }
  for (auto& normal : panel.meshes[0].normals) {
    normal = {0.0F, static_cast<float>(kNormal.y), static_cast<float>(kNormal.z)};
  }
  panel.materials[0].detail.transmission.color.fill(transmittance);
  return panel;
}

/// Sky and reflected light in the middle of a side of the opaque panel.
double AmbientOf(const Vec3& normal, double sun_lux) {
  const auto solver =
      LightSolver::Create({Place(Panel(0.0F, 0.0F), false), kGround}, {.rays_per_vertex = 64});
  double nearest = 1e9, ambient = 0.0;
  for (const LitMesh& mesh : (*solver)->Solve(SouthernSun(sun_lux), Mat3{})) {
    if (mesh.placed_model != 0) continue;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const auto& [x, y, z] = mesh.positions[i];
      const auto& [nx, ny, nz] = mesh.normals[i];
      if (Dot(Vec3{nx, ny, nz}, normal) < 0.9) continue;
      const double distance = Norm(Vec3{x, y, z} - kCentre);
      if (distance >= nearest) continue;
      nearest = distance;
      ambient = mesh.ambient_with[i][1];
    }
  }
  return ambient;
}

TEST(ComposerLeaf, ShowsLightFromBehind) {
  const double in_sun = kSunLux * -Dot(kNormal, SouthernSun().ToSun().xyz);
  ASSERT_GT(in_sun, 0.2 * kSunLux);
  const double front = AmbientOf(kNormal, kSunLux), back = AmbientOf(-kNormal, kSunLux);
  for (const auto& [reflectance, transmittance] : {std::pair(0.4F, 0.3F), std::pair(0.0F, 0.5F)}) {
    const RgbImage composed =
        Compose({Place(Panel(reflectance, transmittance), false), kGround}, EvenPicture(0));
    const double expected = kExposureScale * std::numbers::inv_pi *
                            (reflectance * front + transmittance * (back + in_sun));
    EXPECT_NEAR(SeenAt(composed, kCentre), expected, 0.04 * expected)
        << reflectance << ' ' << transmittance;
  }
}

TEST(ComposerLeaf, ShowsTheShadowOnTheOtherSide) {
  // A cube between the sun and the panel.
  const Model block = MakeBox({-0.2, -0.55, 0.9}, {0.2, -0.35, 1.8}, 0.0F);
  const auto seen = [](const std::vector<PlacedModel>& scene) {
    return SeenAt(Compose(scene, EvenPicture(0)), kCentre);
  };
  const PlacedModel panel = Place(Panel(0.0F, 0.5F), false);
  EXPECT_LT(seen({panel, kGround, Place(block, false)}), 0.4 * seen({panel, kGround}));
}

TEST(ComposerLeaf, WithoutTransmissionLooksLikeAnOpaqueSurface) {
  const RgbImage opaque = Compose({Place(Panel(0.3F, 0.0F), false), kGround}, EvenPicture(90));
  Model leaf = Panel(0.3F, 0.0F);
  leaf.materials[0].detail.leaf.emplace();
  leaf.materials[0].detail.leaf->gloss = 0.0F;
  leaf.materials[0].detail.leaf->leaf.model = scene::LeafModel::kPlate;
  const RgbImage shown = Compose({Place(leaf, false), kGround}, EvenPicture(90));
  ASSERT_EQ(shown.size(), opaque.size());
  int largest = 0;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    largest = std::max(largest, std::abs(shown.data()[i] - opaque.data()[i]));
  }
  EXPECT_LE(largest, 1);
}

TEST(ComposerLeaf, IsGreenAndGlossy) {
  LeafSurface leaf;
  leaf.leaf.contents = {.chlorophyll_ug_cm2 = 45, .carotenoids_ug_cm2 = 9, .dry_g_cm2 = 0.005};
  // Level, so that the mirrored sun is 45° from the camera: a rough lobe shows it.
  Model square = MakeBox({-0.5, -0.5, 0.1}, {0.5, 0.5, 0.1}, 0.5F);
  const auto seen = [&](float gloss) {
    leaf.gloss = gloss;
    leaf.roughness = 0.5F;
    ApplyLeaf(leaf, &square.materials[0]);
    const RgbImage image = Compose({Place(square, false)}, EvenPicture(0));
    return std::array<int, 3>{image(160, 120, 0), image(160, 120, 1), image(160, 120, 2)};
  };
  const auto [red, green, blue] = seen(0.0F);
  EXPECT_GT(green, red);
  EXPECT_GT(green, blue);
  // The lobe is white; the diffuse part yields its share.
  EXPECT_GT(seen(4.0F)[2], blue);
}

TEST(LeafMaterial, LeavesNoLightOverAndFollowsTheColorOfTheSun) {
  LeafSurface leaf;
  leaf.leaf.contents = {.chlorophyll_ug_cm2 = 30, .carotenoids_ug_cm2 = 8};
  Material material;
  material.metallic = 1.0F;
  ApplyLeaf(leaf, &material);
  EXPECT_EQ(material.metallic, 0.0F);
  EXPECT_NEAR(SurfaceShareOf(leaf), 0.036, 0.003);
  for (int c = 0; c < 3; ++c) {
    EXPECT_LE(material.base_color[c] + material.detail.transmission.color[c], 1.0F);
  }
  // The whole reflectance is that of the model.
  const LeafColors colors = ColorsOfLeaf(leaf.leaf, LeafIlluminant::D65());
  const double share = SurfaceShareOf(leaf);
  EXPECT_NEAR(share + (1.0 - share) * material.base_color[1], colors.reflectance.g, 1e-5);
  EXPECT_NEAR((1.0 - share) * material.detail.transmission.color[1], colors.transmittance.g, 1e-5);
  const LeafTints noon = LeafTintsIn(leaf, LeafIlluminant::D65(), LeafIlluminant::D65());
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(noon.through_sun[c], 1.0F, 1e-6F);
  const LeafTints evening =
      LeafTintsIn(leaf, LeafIlluminant::OfLight({5.0, 2.0, 0.4}), LeafIlluminant::D65());
  EXPECT_GT(std::abs(evening.through_sun[1] - 1.0F), 0.02F);
  leaf.leaf.model = scene::LeafModel::kPlate;
  EXPECT_EQ(SurfaceShareOf(leaf), 0.0F);
}

}  // namespace
}  // namespace pleinair::compositor
