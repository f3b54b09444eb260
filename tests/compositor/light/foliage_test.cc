#include "compositor/light/foliage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <random>

#include "base/frames.h"
#include "base/vector.h"
#include "compositor/light/light_solver.h"
#include "tests/compositor/light/light_scenes.h"

namespace pleinair::compositor {
namespace {

using testing::AddQuad;
using testing::Ground;
using testing::ModelOf;
using testing::UniformDay;

/// Squares of side `size` in random orientations, within `reach` of `middle` along each axis.
Mesh Scattered(int count, double size, Vec3 middle, Vec3 reach) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> spread(-1.0, 1.0);
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const Vec3 at =
        middle + Vec3{reach.x * spread(random), reach.y * spread(random), reach.z * spread(random)};
    const Vec3 along = Normalized({spread(random), spread(random), spread(random)}) * (size / 2);
    const Vec3 across =
        Normalized(Cross(along, {spread(random), spread(random), spread(random)})) * (size / 2);
    AddQuad(&mesh,
            {at - along - across, at + along - across, at + along + across, at - along + across});
  }
  return mesh;
}

std::optional<SurfaceMesh> LeavesOf(Mesh mesh, SurfaceMesh* rest, bool is_phantom = true) {
  const PlacedModel placed{ModelOf(std::move(mesh), {0.2F, 0.3F, 0.1F}), {}, {}, is_phantom};
  *rest = OrientedSurfaces(placed, 0).front();
  return ExtractFoliage(rest);
}

TEST(Foliage, AreTakenFromATreeWhoseBoughsStay) {
  constexpr int kLeaves = 200;
  Mesh tree = Scattered(kLeaves, 0.15, {0, 0, 3}, {1.2, 1.2, 0.8});
  AddQuad(&tree, {{{0, 0, 0}, {0.1, 0, 0}, {0.1, 0, 3}, {0, 0, 3}}});
  SurfaceMesh rest;
  const auto leaves = LeavesOf(tree, &rest);
  ASSERT_TRUE(leaves);
  EXPECT_EQ(leaves->indices.size(), 6U * kLeaves);
  EXPECT_EQ(leaves->positions.size(), leaves->normals.size());
  EXPECT_EQ(rest.indices.size(), 6U);
  EXPECT_EQ(rest.positions.size(), 4U);
}

TEST(Foliage, AreNeitherFewNorLargeNorAnObjects) {
  SurfaceMesh rest;
  EXPECT_FALSE(LeavesOf(Scattered(40, 0.15, {0, 0, 3}, {1.2, 1.2, 0.8}), &rest));
  EXPECT_FALSE(LeavesOf(Scattered(200, 0.9, {0, 0, 3}, {3, 3, 3}), &rest));
  EXPECT_FALSE(LeavesOf(Scattered(200, 0.15, {0, 0, 3}, {1.2, 1.2, 0.8}), &rest, false));
  EXPECT_EQ(rest.indices.size(), 6U * 200);
}

TEST(Foliage, AreNotWhatLiesInOnePlane) {
  SurfaceMesh rest;
  // Blades of a lawn, at its height or shorter; the oblique links of a fence.
  EXPECT_FALSE(LeavesOf(Scattered(400, 0.08, {0, 0, 0.05}, {2, 2, 0.02}), &rest));
  Mesh links;
  for (int i = 0; i < 100; ++i) {
    const Vec3 at{0.06 * i, 0.045 * i, 0.1 * (i % 10)};
    AddQuad(&links,
            {at, at + Vec3{0.04, 0.03, 0}, at + Vec3{0.04, 0.03, 0.05}, at + Vec3{0, 0, 0.05}});
  }
  EXPECT_FALSE(LeavesOf(links, &rest));
}

TEST(Foliage, AreNotTilesOfARoofOrBricksRoundACorner) {
  Mesh roof, wall;
  for (int i = 0; i < 20; ++i) {
    for (int k = 0; k < 10; ++k) {
      for (const double side : {-1.0, 1.0}) {
        const Vec3 along{0.3, 0, 0}, down{0, side * 0.25, -0.17};
        const Vec3 at = Vec3{0.31 * i, 0, 3} + down * (1.03 * k + 0.1);
        AddQuad(&roof, {at, at + along, at + along + down, at + down});
      }
      const Vec3 up{0, 0, 0.06}, in_x{0.2, 0, 0}, in_y{0, 0.2, 0};
      const Vec3 x{0.21 * i, 0, 0.07 * k}, y{0, 0.21 * i, 0.07 * k};
      AddQuad(&wall, {x, x + in_x, x + in_x + up, x + up});
      AddQuad(&wall, {y, y + up, y + in_y + up, y + in_y});
    }
  }
  SurfaceMesh rest;
  EXPECT_FALSE(LeavesOf(roof, &rest));
  EXPECT_FALSE(LeavesOf(wall, &rest));
}

TEST(Foliage, HideWhatStandsBehindFromWhatIsMeasured) {
  const auto solver = LightSolver::Create(
      {{Ground(3, {0.3F, 0.3F, 0.3F}), {}, {}, true},
       {ModelOf(Scattered(4000, 0.2, {0, 0, 2}, {1, 1, 0.6}), {0.1F, 0.2F, 0.05F}), {}, {}, true}},
      {});
  ASSERT_TRUE(solver);
  const auto through = (*solver)->phantoms().First({{0, 0, 5}}, {0, 0, -1});
  ASSERT_TRUE(through);
  EXPECT_TRUE(through->is_foliage);
  EXPECT_GT(through->point.xyz.z, 1.2);
  const auto beside = (*solver)->phantoms().First({{2, 2, 5}}, {0, 0, -1});
  ASSERT_TRUE(beside);
  EXPECT_FALSE(beside->is_foliage);
  EXPECT_NEAR(beside->point.xyz.z, 0.0, 1e-6);
}

TEST(Foliage, LetSunAndSkyThroughAndAreDrawnAllTheSame) {
  // So dense that hardly any ray from the centre of the ground passes.
  const Mesh crown = Scattered(4000, 0.2, {0, 0, 2}, {1, 1, 0.6});
  const auto solver = LightSolver::Create({{Ground(1.5, {0.3F, 0.3F, 0.3F}), {}, {}, true},
                                           {ModelOf(crown, {0.1F, 0.2F, 0.05F}), {}, {}, true}},
                                          {});
  ASSERT_TRUE(solver);
  EXPECT_EQ((*solver)->phantoms().SunVisibility({{0, 0, 0}}, {0, 0, 1}), 1.0);
  const auto lit = (*solver)->Solve(UniformDay({1, 1, 1}), {});
  const auto drawn_leaves = std::count_if(lit.begin(), lit.end(), [](const LitMesh& mesh) {
    return mesh.placed_model == 1 && mesh.is_phantom && mesh.role == MeshRole::kRenderOnly;
  });
  EXPECT_EQ(drawn_leaves, 2);  // One for each side.
}

}  // namespace
}  // namespace pleinair::compositor
