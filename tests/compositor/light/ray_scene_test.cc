#include "compositor/light/ray_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

namespace pleinair::compositor {
namespace {

/// A mesh of copies of one triangle in the plane z = 0, each with corners of its own.
RayMesh Copies(std::uint32_t count) {
  RayMesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    mesh.positions.insert(mesh.positions.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    mesh.indices.insert(mesh.indices.end(), {3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

bool HitsAfterMovingAllBut(std::uint32_t kept, std::uint32_t count) {
  const RayMesh mesh = Copies(count);
  const auto scene = RayScene::Create({mesh}, "model");
  EXPECT_TRUE(scene);
  std::vector<std::vector<std::array<float, 3>>> positions = {mesh.positions};
  for (std::uint32_t i = 0; i < 3 * count; ++i) {
    if (i / 3 != kept) positions[0][i][2] = -5.0F;
  }
  (*scene)->SetPositions(positions);
  RayHit hit;
  EXPECT_TRUE((*scene)->Intersect(RayTargets::kEverything, {0.2, 0.2, 1.0}, {0, 0, -1}, &hit));
  return hit.distance_m < 2.0;
}

TEST(RayScene, KeepsAFewCopiesOfATriangleAndNotThousands) {
  EXPECT_TRUE(HitsAfterMovingAllBut(0, 10'000));
  EXPECT_TRUE(HitsAfterMovingAllBut(1, 2));
  EXPECT_FALSE(HitsAfterMovingAllBut(9'999, 10'000));
}

TEST(RayScene, CountsCopiesAmongPhantomsApart) {
  RayMesh phantom = Copies(1);
  phantom.is_phantom = true;
  const auto scene = RayScene::Create({Copies(100), phantom}, "model");
  ASSERT_TRUE(scene);
  RayHit hit;
  EXPECT_TRUE((*scene)->Intersect(RayTargets::kPhantoms, {0.2, 0.2, 1.0}, {0, 0, -1}, &hit));
}

}  // namespace
}  // namespace pleinair::compositor
