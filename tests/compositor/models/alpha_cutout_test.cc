#include "compositor/models/alpha_cutout.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

#include "base/vector.h"
#include "compositor/models/model.h"

namespace pleinair::compositor {
namespace {

/// A square of 1 m, two triangles, with a texture of 128 × 128 texels, repeated `repeats` times per
/// side.
Model Card(float repeats, bool (*is_hole)(double, double)) {
  constexpr int kSide = 128;
  Model model;
  model.materials.push_back({});
  model.materials[0].base_color_texture = 0;
  Image<std::uint8_t> texture(kSide, kSide, 4);
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      texture(x, y, 3) = is_hole((x + 0.5) / kSide, (y + 0.5) / kSide) ? 0 : 255;
    }
  }
  model.textures.push_back(std::move(texture));
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.uvs = {{0, 0}, {repeats, 0}, {repeats, repeats}, {0, repeats}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  model.meshes.push_back(mesh);
  return model;
}

bool RoundHole(double u, double v) { return std::hypot(u - 0.5, v - 0.5) < 0.3; }
bool LeftHalf(double u, double) { return u < 0.5; }
bool Everywhere(double, double) { return true; }
bool Nowhere(double, double) { return false; }

/// Area of the geometry that casts shadows, counting triangles whose centroid satisfies `inside`.
template <typename Inside>
double Area(const Model& model, const Inside& inside) {
  double area = 0.0;
  for (const Mesh& mesh : model.meshes) {
    if (mesh.role == MeshRole::kRenderOnly) continue;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      Vec3 p[3];
      for (int c = 0; c < 3; ++c) {
        const auto& at = mesh.positions[mesh.indices[i + static_cast<std::size_t>(c)]];
        p[c] = {at[0], at[1], at[2]};
      }
      const Vec3 middle = (p[0] + p[1] + p[2]) * (1.0 / 3.0);
      const Vec3 across = Cross(p[1] - p[0], p[2] - p[0]);
      EXPECT_GT(across.z, 0.0) << "wound the other way round";
      if (inside(middle.x, middle.y)) area += Norm(across) / 2;
    }
  }
  return area;
}
double Area(const Model& model) {
  return Area(model, [](double, double) { return true; });
}

TEST(ApplyAlphaCutout, LeavesWhatIsNoHole) {
  Model card = Card(1.0F, RoundHole);
  ApplyAlphaCutout(&card);
  const double hole = std::numbers::pi * 0.3 * 0.3;
  // The geometry covers all opaque texels and exceeds them by up to a 64th of the side and a texel.
  EXPECT_NEAR(Area(card), 1.0 - hole, 2 * std::numbers::pi * 0.3 * (1.0 / 64 + 1.0 / 128));
  EXPECT_EQ(Area(card, [](double x, double y) { return std::hypot(x - 0.5, y - 0.5) < 0.26; }),
            0.0);
  EXPECT_NEAR(Area(card, [](double x, double y) { return !RoundHole(x, y); }), 1.0 - hole, 0.01);
  EXPECT_LT(card.meshes[0].indices.size() / 3, 2000U);
  // The drawn mesh is complete.
  ASSERT_EQ(card.meshes.size(), 2U);
  EXPECT_EQ(card.meshes[0].role, MeshRole::kShadowOnly);
  EXPECT_EQ(card.meshes[1].role, MeshRole::kRenderOnly);
  EXPECT_EQ(card.meshes[1].indices, Card(1.0F, RoundHole).meshes[0].indices);
}

TEST(ApplyAlphaCutout, FollowsATextureThatRepeats) {
  Model card = Card(3.0F, LeftHalf);
  for (auto& uv : card.meshes[0].uvs) uv[0] -= 7.0F;
  ApplyAlphaCutout(&card);
  EXPECT_NEAR(Area(card), 0.5, 0.1);
  EXPECT_EQ(Area(card, [](double x, double) { return std::fabs(x - 1.25 / 3) < 0.02; }), 0.0);
}

TEST(ApplyAlphaCutout, KeepsToItsLimitAndAllThatIsDrawn) {
  Model card = Card(8.0F, RoundHole);
  ApplyAlphaCutout(&card, 100);
  EXPECT_LE(card.meshes[0].indices.size() / 3, 102U);
  EXPECT_GT(Area(card), 1.0 - std::numbers::pi * 0.3 * 0.3);
}

TEST(ApplyAlphaCutout, ChangesNothingWhereNoHoleIsCut) {
  Model card = Card(1.0F, Nowhere);
  ApplyAlphaCutout(&card);
  EXPECT_EQ(card.meshes[0].indices.size(), 6U);
  card = Card(1.0F, RoundHole);
  card.materials[0].alpha = Material::Alpha::kIgnored;
  ApplyAlphaCutout(&card);
  EXPECT_EQ(card.meshes[0].indices.size(), 6U);
  // For any texture coordinates in the file.
  card = Card(1.0F, RoundHole);
  card.meshes[0].uvs[0] = {1e30F, -1e30F};
  ApplyAlphaCutout(&card);
  EXPECT_EQ(card.meshes[0].indices.size(), 6U);
  card = Card(1.0F, RoundHole);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (auto& uv : card.meshes[0].uvs) uv = {nan, nan};
  ApplyAlphaCutout(&card);
  EXPECT_EQ(card.meshes[0].indices.size(), 6U);
}

TEST(ApplyAlphaCutout, LetsLightThroughGlassThatHidesLessThanHalf) {
  const auto card_of = [](float opacity, bool (*is_hole)(double, double)) {
    Model card = Card(1.0F, is_hole);
    card.materials[0].alpha = Material::Alpha::kBlended;
    card.materials[0].alpha_cutoff = 0.1F;  // No effect on blended materials.
    card.materials[0].opacity = opacity;
    ApplyAlphaCutout(&card);
    return card;
  };
  const auto drawn = [](const Model& card) {
    std::size_t indices = 0;
    for (const Mesh& mesh : card.meshes) {
      if (mesh.role != MeshRole::kShadowOnly) indices += mesh.indices.size();
    }
    return indices;
  };
  EXPECT_DOUBLE_EQ(Area(card_of(0.6F, Nowhere)), 1.0);
  EXPECT_DOUBLE_EQ(Area(card_of(0.4F, Nowhere)), 0.0);
  EXPECT_NEAR(Area(card_of(0.9F, RoundHole)), 1.0 - std::numbers::pi * 0.3 * 0.3, 0.05);
  EXPECT_DOUBLE_EQ(Area(card_of(0.9F, Everywhere)), 0.0);
  // The drawn mesh is unchanged, however thin it is.
  for (const float opacity : {0.9F, 0.4F}) {
    for (const auto is_hole : {Nowhere, RoundHole, Everywhere}) {
      EXPECT_EQ(drawn(card_of(opacity, is_hole)), 6U);
    }
  }
}

TEST(ApplyAlphaCutout, TakesOutWhatItsMaterialAloneCutsOut) {
  Model card = Card(1.0F, Nowhere);
  card.materials[0].base_color_texture = -1;
  ApplyAlphaCutout(&card);
  ASSERT_EQ(card.meshes.size(), 1U);
  card.materials[0].opacity = 0.4F;
  ApplyAlphaCutout(&card);
  EXPECT_TRUE(card.meshes.empty());
}

TEST(ApplyAlphaCutout, LeavesNothingOfAMeshThatIsNothingButHoles) {
  Model card = Card(1.0F, Everywhere);
  card.materials.push_back({});
  card.meshes.push_back(card.meshes[0]);
  card.meshes[1].material = 1;
  ApplyAlphaCutout(&card);
  ASSERT_EQ(card.meshes.size(), 1U);
  EXPECT_EQ(card.meshes[0].material, 1);
}

}  // namespace
}  // namespace pleinair::compositor
