#include "compositor/light/sun_visibility.h"
#include "compositor/light/light_solver.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/compositor/light/light_scenes.h"

namespace pleinair::compositor {
namespace {

using testing::BoxModel;
using testing::Ground;
using testing::Phantom;
using testing::UniformDay;

Vec3 At(const std::array<float, 3>& v) { return {v[0], v[1], v[2]}; }

TEST(SunVisibility, IsAllInTheOpenNoneInAShadowAndSomeOnItsEdge) {
  // A wall 0.8 m high along y = 0, the sun 45° high in the south: the shadow reaches from y = 0 to
  // 0.8.
  const std::vector<PlacedModel> scene{
      Phantom(Ground(4.0, {0.3F, 0.3F, 0.3F})),
      Phantom(BoxModel({-6.0, -0.1, -0.1}, {6.0, 0.0, 0.8}, {0.5F, 0.5F, 0.5F}))};
  const auto solver = LightSolver::Create(scene, {.rays_per_vertex = 16});
  ASSERT_TRUE(solver) << solver.error().Message();
  const UniformDay day({1000, 1000, 1000}, {60e3, 60e3, 60e3}, {0, -1, 1});
  int all = 0, none = 0, some = 0, turned_away = 0;
  for (const LitMesh& mesh : (*solver)->Solve(day, Mat3{})) {
    ASSERT_EQ(mesh.sunlight.by_triangle.size(), mesh.indices.size() / 3);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      double low = 1e9, high = -1e9, level = 0.0, facing = 0.0;
      for (std::size_t k = i; k < i + 3; ++k) {
        const Vec3 p = At(mesh.positions[mesh.indices[k]]);
        low = std::min(low, p.y);
        high = std::max(high, p.y);
        level = std::max(level, std::fabs(p.z));
        facing = std::max(facing, Dot(At(mesh.normals[mesh.indices[k]]), {0, -1, 1}));
      }
      const SunVisibility reach = mesh.sunlight.by_triangle[i / 3];
      if (facing <= 0.0) {
        EXPECT_EQ(reach, SunVisibility::kNone) << "turned away";
        ++turned_away;
      } else if (level < 1e-6 && low > 0.83) {
        EXPECT_EQ(reach, SunVisibility::kAll) << low << " to " << high;
        ++all;
      } else if (level < 1e-6 && low > 0.01 && high < 0.77) {
        EXPECT_EQ(reach, SunVisibility::kNone) << low << " to " << high;
        ++none;
      } else if (level < 1e-6 && low < 0.77 && high > 0.83) {
        EXPECT_EQ(reach, SunVisibility::kSome) << low << " to " << high;
        ++some;
      }
    }
  }
  EXPECT_GT(all, 10);
  EXPECT_GT(none, 2);
  EXPECT_GT(some, 2);
  EXPECT_GT(turned_away, 2);
}

TEST(SunVisibility, IsNotKnownOfALightByCoefficients) {
  const auto solver =
      LightSolver::Create({Phantom(Ground(1.0, {0.3F, 0.3F, 0.3F}))}, {.rays_per_vertex = 16});
  ASSERT_TRUE(solver) << solver.error().Message();
  const UniformDay day({1000, 1000, 1000}, {60e3, 60e3, 60e3}, {0, -1, 1});
  const DaylightCoefficients coefficients = (*solver)->Coefficients({0, 0, 1}, {}, {});
  const std::vector<LitMesh> lit = (*solver)->Relight(coefficients, day, Mat3{});
  ASSERT_FALSE(lit.empty());
  for (const LitMesh& mesh : lit) {
    EXPECT_TRUE(mesh.sunlight.by_triangle.empty()) << "rays would take longer than the light";
  }
}

TEST(SunVisibility, IsNotAskedUnderAnOvercastSky) {
  const auto solver =
      LightSolver::Create({Phantom(Ground(1.0, {0.3F, 0.3F, 0.3F}))}, {.rays_per_vertex = 16});
  ASSERT_TRUE(solver) << solver.error().Message();
  const std::vector<LitMesh> lit =
      (*solver)->Solve(UniformDay({1000, 1000, 1000}, {0, 0, 0}, {0, -1, 1}), Mat3{});
  ASSERT_FALSE(lit.empty());
  for (const LitMesh& mesh : lit) EXPECT_TRUE(mesh.sunlight.by_triangle.empty());
}

TEST(SunVisibility, SeesAStripOfShadeAQuarterOfATriangleWideWhereverItFalls) {
  LitMesh triangle;
  triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.normals.assign(3, {0, 0, 1});
  triangle.indices = {0, 1, 2};
  // Along the edge opposite the second corner, with the sun overhead.
  for (const float from : {0.02F, 0.1F, 0.2F, 0.3F, 0.4F, 0.5F, 0.6F, 0.7F, 0.74F}) {
    const float to = from + 0.24F;
    const RayMesh strip{
        {{from, -1, 1}, {to, -1, 1}, {to, 2, 1}, {from, 2, 1}}, {0, 1, 2, 0, 2, 3}, true};
    const auto rays = RayScene::Create({strip}, "strip");
    ASSERT_TRUE(rays) << rays.error().Message();
    EXPECT_EQ(ClassifySunVisibility(**rays, triangle, {0, 0, 1}, 1)[0], SunVisibility::kSome)
        << from;
  }
}

}  // namespace
}  // namespace pleinair::compositor
