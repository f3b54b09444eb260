// Tests the lower side of ground. Points that see only land need no rays; others do.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "compositor/light/light_solver.h"
#include "tests/compositor/light/light_scenes.h"

namespace pleinair::compositor {
namespace {

using testing::BoxModel;
using testing::Ground;
using testing::Phantom;
using testing::UniformDay;

constexpr Vec3 kDown{0.0, 0.0, -1.0};

/// The vertices of a level sheet's lower side, with path-traced light.
struct LowerSide {
  std::vector<Point<Marker>> points;
  std::vector<double> light, paths;
};

LowerSide Below(const std::vector<PlacedModel>& scene) {
  const UniformDay day({1000, 1000, 1000}, {50e3, 50e3, 50e3}, {0.3, 0.2, 1});
  const auto solver = *LightSolver::Create(scene, {.near_edge_m = 0.2});
  LowerSide side;
  for (const LitMesh& mesh : solver->Solve(day, Mat3{})) {
    if (mesh.placed_model != 0 || mesh.normals[0][2] > -0.9F) continue;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const auto& p = mesh.positions[i];
      side.points.push_back({{p[0], p[1], p[2]}});
      side.light.push_back(mesh.ambient_without[i][1]);
    }
  }
  for (const LinearRgb& light : solver->phantoms().Ambient(side.points, kDown, day, Mat3{})) {
    side.paths.push_back(light.g);
  }
  return side;
}

const PlacedModel kSheet = Phantom(Ground(1.0, {0.3F, 0.3F, 0.3F}, false, 1.0));

TEST(LowerSideLight, IsTheLandsAlone) {
  const LowerSide side = Below({kSheet});
  ASSERT_GT(side.points.size(), 20U);
  for (std::size_t i = 0; i < side.points.size(); ++i) {
    EXPECT_GT(side.light[i], 0.0);
    EXPECT_NEAR(side.light[i], side.paths[i], 1e-3 * side.paths[i]);
  }
}

TEST(LowerSideLight, IsKeptOffByALittleBodyBelow) {
  // Black, 30 cm wide: it occludes most directions of the vertices close above it, and few of
  // others.
  const LowerSide side =
      Below({kSheet, Phantom(BoxModel({-0.15, -0.15, 0.7}, {0.15, 0.15, 0.9}, {}))});
  ASSERT_EQ(side.light.size(), side.paths.size());
  const LowerSide bare = Below({kSheet});
  int darkened = 0;
  for (std::size_t i = 0; i < side.points.size(); ++i) {
    EXPECT_NEAR(side.light[i], side.paths[i], 0.03 * bare.paths[0]);
    darkened += side.light[i] < 0.7 * bare.light[0] ? 1 : 0;
  }
  EXPECT_GT(darkened, 0);
}

}  // namespace
}  // namespace pleinair::compositor
