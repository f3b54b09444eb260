#include "compositor/loose_leaves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <random>

#include "base/frames.h"
#include "base/vector.h"
#include "compositor/light_solver.h"
#include "tests/compositor/light_scenes.h"

namespace pleinair::compositor {
namespace {

using testing::AddQuad;
using testing::Ground;
using testing::ModelOf;
using testing::UniformDay;

/// Square pieces of side `size` in all positions, within `reach` of `middle` along each axis.
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
  return TakeLooseLeaves(rest);
}

TEST(LooseLeaves, AreTakenFromATreeWhoseBoughsStay) {
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

TEST(LooseLeaves, AreNeitherFewNorLargeNorAnObjects) {
  SurfaceMesh rest;
  EXPECT_FALSE(LeavesOf(Scattered(40, 0.15, {0, 0, 3}, {1.2, 1.2, 0.8}), &rest));
  EXPECT_FALSE(LeavesOf(Scattered(200, 0.9, {0, 0, 3}, {3, 3, 3}), &rest));
  EXPECT_FALSE(LeavesOf(Scattered(200, 0.15, {0, 0, 3}, {1.2, 1.2, 0.8}), &rest, false));
  EXPECT_EQ(rest.indices.size(), 6U * 200);
}

TEST(LooseLeaves, AreNotWhatLiesInOnePlane) {
  SurfaceMesh rest;
  // Blades of a lawn, of its height or shorter; a fence's links aslant.
  EXPECT_FALSE(LeavesOf(Scattered(400, 0.08, {0, 0, 0.05}, {2, 2, 0.02}), &rest));
  Mesh links;
  for (int i = 0; i < 100; ++i) {
    const Vec3 at{0.06 * i, 0.045 * i, 0.1 * (i % 10)};
    AddQuad(&links,
            {at, at + Vec3{0.04, 0.03, 0}, at + Vec3{0.04, 0.03, 0.05}, at + Vec3{0, 0, 0.05}});
  }
  EXPECT_FALSE(LeavesOf(links, &rest));
}

TEST(LooseLeaves, LetSunAndSkyThroughAndAreDrawnAllTheSame) {
  // So dense that hardly a ray from the middle of the ground would pass.
  const Mesh crown = Scattered(4000, 0.2, {0, 0, 2}, {1, 1, 0.6});
  const auto solver = LightSolver::Create({{Ground(1.5, {0.3F, 0.3F, 0.3F}), {}, {}, true},
                                           {ModelOf(crown, {0.1F, 0.2F, 0.05F}), {}, {}, true}},
                                          {});
  ASSERT_TRUE(solver);
  EXPECT_EQ((*solver)->SunVisibilityPhantomsOnly({{0, 0, 0}}, {0, 0, 1}), 1.0);
  const auto lit = (*solver)->Solve(UniformDay({1, 1, 1}), {});
  const auto drawn_leaves = std::count_if(lit.begin(), lit.end(), [](const LitMesh& mesh) {
    return mesh.placed_model == 1 && mesh.is_phantom && mesh.role == MeshRole::kDrawn;
  });
  EXPECT_EQ(drawn_leaves, 2);  // Either side.
}

}  // namespace
}  // namespace pleinair::compositor
