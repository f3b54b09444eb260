#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "compositor/light/light_solver.h"
#include "tests/compositor/light/light_scenes.h"

namespace pleinair::compositor {
namespace {

using testing::AddQuad;
using testing::BoxModel;
using testing::FoundVertex;
using testing::Ground;
using testing::MakeSolver;
using testing::ModelOf;
using testing::Nearest;
using testing::Object;
using testing::Phantom;
using testing::UniformDay;

constexpr double kPi = std::numbers::pi;
constexpr Vec3 kUp{0.0, 0.0, 1.0};

TEST(LightSolver, LeavesHalfTheSkyToAWallOnDarkGround) {
  const auto meshes =
      MakeSolver({Phantom(Ground(2000.0, {0.0F, 0.0F, 0.0F})),
                  Object(BoxModel({-0.2, -0.2, 0.0}, {0.2, 0.2, 0.4}, {0.5F, 0.5F, 0.5F}))})
          ->Solve(UniformDay({1.0, 1.0, 1.0}), Mat3{});
  const FoundVertex side = Nearest(meshes, {0.2, 0.0, 0.2}, {1, 0, 0});
  EXPECT_LT(side.distance_m, 0.05);
  EXPECT_NEAR(side.with[1], 0.5 * kPi, 0.015 * kPi);
  const FoundVertex top = Nearest(meshes, {0.0, 0.0, 0.4}, kUp);
  EXPECT_NEAR(top.with[1], kPi, 0.01 * kPi);
}

TEST(LightSolver, ShadesGroundBesideALongWallByItsViewFactor) {
  // A wall of height h, 40 m long. At distance d it occludes (1 − cos θ)/2 of the sky, tan θ = h/d
  // (view factor from a level strip to an infinitely long wall).
  const auto meshes =
      MakeSolver({Phantom(Ground(4.0, {0.0F, 0.0F, 0.0F})),
                  Object(BoxModel({-0.3, -20.0, 0.0}, {0.0, 20.0, 1.0}, {0.0F, 0.0F, 0.0F}))},
                 {.near_edge_m = 0.15})
          ->Solve(UniformDay({1.0, 1.0, 1.0}), Mat3{});
  for (const double distance : {0.25, 0.5, 1.0, 2.0}) {
    double sum = 0.0, expected = 0.0;
    int count = 0;
    for (const LitMesh& mesh : meshes) {
      if (!mesh.is_phantom || mesh.normals[0][2] < 0.5F) continue;
      for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const auto& p = mesh.positions[i];
        if (std::fabs(p[0] - distance) > 0.2 * distance || std::fabs(p[1]) > 3.0F) continue;
        const double theta = std::atan2(1.0, static_cast<double>(p[0]));
        expected += kPi * (1.0 - (1.0 - std::cos(theta)) / 2.0);
        sum += mesh.ambient_with[i][1];
        EXPECT_NEAR(mesh.ambient_without[i][1], kPi, 0.01 * kPi);
        ++count;
      }
    }
    ASSERT_GT(count, 3) << distance;
    EXPECT_NEAR(sum / count, expected / count, 0.01 * kPi) << distance;
  }
}

TEST(LightSolver, KeepsHalfTheSkyBesideABox) {
  // Ground vertices inside the box must not darken the triangles that extend below its side.
  const auto meshes =
      MakeSolver({Phantom(Ground(5.0, {0.0F, 0.0F, 0.0F})),
                  Object(BoxModel({-1.013, -1.013, 0.0}, {1.013, 1.013, 2.0}, {0.0F, 0.0F, 0.0F}))})
          ->Solve(UniformDay({1.0, 1.0, 1.0}), Mat3{});
  int inside = 0;
  for (const LitMesh& mesh : meshes) {
    if (!mesh.is_phantom || mesh.normals[0][2] < 0.5F) continue;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const auto& p = mesh.positions[i];
      if (std::fabs(p[1]) > 0.3F || p[0] < 0.9F || p[0] > 1.06F) continue;
      EXPECT_NEAR(mesh.ambient_with[i][1], 0.5 * kPi, 0.06 * kPi) << p[0];
      inside += p[0] < 1.0F ? 1 : 0;
    }
  }
  EXPECT_GT(inside, 0);
}

struct TopLight {
  double area_m2 = 0.0;
  double mean = 0.0;  ///< Green, weighted by area.
};

/// Upper sides of the first model.
TopLight MeanOnTop(const std::vector<LitMesh>& meshes) {
  double sum = 0.0, area = 0.0;
  for (const LitMesh& mesh : meshes) {
    if (mesh.placed_model != 0 || mesh.normals[0][2] < 0.5F) continue;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
      std::array<Vec3, 3> p;
      double light = 0.0;
      for (int c = 0; c < 3; ++c) {
        const auto& q = mesh.positions[mesh.indices[t + c]];
        p[c] = {q[0], q[1], q[2]};
        light += mesh.ambient_with[mesh.indices[t + c]][1] / 3.0;
      }
      const double a = Norm(Cross(p[1] - p[0], p[2] - p[0])) / 2.0;
      sum += light * a;
      area += a;
    }
  }
  return {area, sum / area};
}

TEST(LightSolver, AgreesWithTheFormFactorOfParallelSquares) {
  // Two parallel unit squares at unit distance have F = 0.1998 (Howell's catalogue, C-11, X = Y =
  // 1). A black upper square reduces the lower one's mean skylight by that share.
  Mesh upper;
  AddQuad(&upper, {{{-0.5, -0.5, 1.0}, {0.5, -0.5, 1.0}, {0.5, 0.5, 1.0}, {-0.5, 0.5, 1.0}}});
  const auto meshes = MakeSolver({Object(Ground(0.5, {0.0F, 0.0F, 0.0F})),
                                  Object(ModelOf(upper, {0.0F, 0.0F, 0.0F}))})
                          ->Solve(UniformDay({1.0, 1.0, 1.0}), Mat3{});
  const auto [area, light] = MeanOnTop(meshes);
  EXPECT_NEAR(area, 1.0, 1e-4);
  EXPECT_NEAR(1.0 - light / kPi, 0.1998, 0.01 * 0.1998);
}

TEST(LightSolver, BouncesTheFormFactorOfPerpendicularSquares) {
  // Unit squares with a common edge: F = 0.2000 (Howell's catalogue, C-14, H = W = 1). The
  // horizontal sun lights only the upright square; the ground's mean light is then ρ E F.
  Mesh upright;
  AddQuad(&upright, {{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {1.0, 0.0, 1.0}, {0.0, 0.0, 1.0}}});
  Mesh level;
  AddQuad(&level, {{{0.0, -1.0, 0.0}, {1.0, -1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}});
  const auto meshes = MakeSolver({Object(ModelOf(level, {0.0F, 0.0F, 0.0F})),
                                  Object(ModelOf(upright, {0.5F, 0.5F, 0.5F}))},
                                 {.bounces = 1})
                          ->Solve(UniformDay({}, {1000.0, 1000.0, 1000.0}, {0, -1, 1e-6}), Mat3{});
  const auto [area, light] = MeanOnTop(meshes);
  EXPECT_NEAR(light / 500.0, 0.2000, 0.01 * 0.2000);
}

}  // namespace
}  // namespace pleinair::compositor
