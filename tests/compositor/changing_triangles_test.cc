#include "compositor/changing_triangles.h"

#include <gmock/gmock.h>

namespace pleinair::compositor {
namespace {

using testing::ElementsAre;

/// Four triangles a metre apart along x, all facing up.
LitMesh Row() {
  LitMesh mesh;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const auto x = static_cast<float>(i);
    for (const auto& [dx, dy] : {std::pair{0.0F, 0.0F}, {0.5F, 0.0F}, {0.0F, 0.5F}}) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back({x + dx, dy, 0.0F});
      mesh.normals.push_back({0.0F, 0.0F, 1.0F});
      mesh.ambient_without.push_back({1000.0F, 1000.0F, 1000.0F});
      mesh.ambient_with.push_back(mesh.ambient_without.back());
    }
  }
  return mesh;
}

// A square of 1 m across a sun overhead, from x = 0.9 m on.
const SunWindow kWindow{{1.0F, 0.0F, 0.0F, -0.9F}, {0.0F, 1.0F, 0.0F, 0.0F}, 1.0F, {0, 0, 1}};

TEST(ChangingTriangles, AreThoseInTheSunsWindowAndThoseWhoseSkyChanges) {
  LitMesh mesh = Row();
  mesh.ambient_with[3 * 3 + 1][2] = 990.0F;  // A corner of the last, in blue alone.
  mesh.ambient_with[0][0] = 999.0F;          // Less than is seen.
  ChangingTriangles triangles(mesh);
  triangles.Sort(kWindow);
  EXPECT_THAT(triangles.ends(), ElementsAre(3, 6, 6, 12));
  EXPECT_THAT(triangles.indices(), ElementsAre(3, 4, 5, 9, 10, 11, 0, 1, 2, 6, 7, 8));
}

TEST(ChangingTriangles, InTheirOwnShadeNeedNoShadowMaps) {
  LitMesh mesh = Row();
  mesh.ambient_with[4][0] = mesh.ambient_with[10][0] = 900.0F;
  for (auto& normal : mesh.normals) normal = {0.0F, 0.0F, -1.0F};
  ChangingTriangles triangles(mesh);
  triangles.Sort(kWindow);
  EXPECT_THAT(triangles.ends(), ElementsAre(0, 0, 6, 12));
  triangles.Sort({});
  EXPECT_THAT(triangles.ends(), ElementsAre(0, 0, 6, 12)) << "without a sun";
}

TEST(ChangingTriangles, AreAllThatTheSunReachesWhereItsWindowIsUnknown) {
  ChangingTriangles triangles(Row());
  triangles.Sort(SunWindow::Everywhere({0, 0, 1}));
  EXPECT_THAT(triangles.ends(), ElementsAre(12, 12, 12, 12));
}

}  // namespace
}  // namespace pleinair::compositor
