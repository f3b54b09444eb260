// Tests light that leaves transmit, against the adding method (Stokes 1862): two level leaves over
// black ground.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <numbers>
#include <vector>

#include "compositor/light/light_solver.h"
#include "tests/compositor/light/light_scenes.h"

namespace pleinair::compositor {
namespace {

using testing::Float3;
using testing::Ground;
using testing::MakeSolver;
using testing::Nearest;
using testing::Object;
using testing::Phantom;
using testing::UniformDay;

constexpr Vec3 kUp{0, 0, 1}, kDown{0, 0, -1};
constexpr double kHalf_m = 2.0, kLow_m = 0.02, kHigh_m = 0.04;
constexpr LightSolverOptions kManyBounces{
    .rays_per_vertex = 128, .bounces = 10, .near_edge_m = 1.0};

std::shared_ptr<Model> LeafAt(double z, float reflectance, float transmittance,
                              bool upside_down = false) {
  auto leaf = Ground(kHalf_m, {reflectance, reflectance, reflectance}, upside_down, z);
  leaf->materials[0].detail.transmission.color.fill(transmittance);
  return leaf;
}

std::vector<PlacedModel> TwoLeaves(float r, float t, bool upside_down = false) {
  return {Phantom(Ground(kHalf_m, {0.0F, 0.0F, 0.0F})), Object(LeafAt(kLow_m, r, t, upside_down)),
          Object(LeafAt(kHigh_m, r, t))};
}

struct Irradiances {
  double ground = 0.0, low_top = 0.0, high_bottom = 0.0;
};
Irradiances InTheMiddle(const std::vector<LitMesh>& meshes) {
  return {testing::Green(Nearest(meshes, {0, 0, 0}, kUp).with),
          testing::Green(Nearest(meshes, {0, 0, kLow_m}, kUp).with),
          testing::Green(Nearest(meshes, {0, 0, kHigh_m}, kDown).with)};
}

void ExpectAdded(const Irradiances& light, double r, double t, double above, double tolerance) {
  const double between = 1.0 / (1.0 - r * r);
  EXPECT_NEAR(light.low_top, above * t * between, tolerance * above * t);
  EXPECT_NEAR(light.high_bottom, above * t * r * between, tolerance * above * t);
  EXPECT_NEAR(light.ground, above * t * t * between, tolerance * above * t * t * between);
}

TEST(TranslucentLight, AddsUpBetweenTwoLeaves) {
  constexpr float kR = 0.45F, kT = 0.4F;
  const UniformDay sky({1e3, 1e3, 1e3});
  const UniformDay sun({}, {5e4, 5e4, 5e4}, {0.5, 0.2, 1.0});
  const double of_sun = 5e4 * sun.ToSun().xyz.z;
  for (const bool upside_down : {false, true}) {
    const auto solver = MakeSolver(TwoLeaves(kR, kT, upside_down), kManyBounces);
    ExpectAdded(InTheMiddle(solver->Solve(sky, Mat3{})), kR, kT, 1e3 * std::numbers::pi, 0.02);
    ExpectAdded(InTheMiddle(solver->Solve(sun, Mat3{})), kR, kT, of_sun, 0.02);
  }
}

TEST(TranslucentLight, IsTheSameByDaylightCoefficients) {
  constexpr float kR = 0.45F, kT = 0.4F;
  const auto solver = MakeSolver(TwoLeaves(kR, kT), kManyBounces);
  const auto coefficients =
      solver->Coefficients(kUp, {.rays_per_vertex = 128, .convergence = 0.001}, {});
  const UniformDay sky({1e3, 1e3, 1e3});
  ExpectAdded(InTheMiddle(solver->Relight(coefficients, sky, Mat3{})), kR, kT,
              1e3 * std::numbers::pi, 0.02);
}

TEST(TranslucentLight, ReachesTheOtherSideOfItsMesh) {
  const auto meshes =
      MakeSolver(TwoLeaves(0.3F, 0.3F), kManyBounces)->Solve(UniformDay({1e3, 1e3, 1e3}), Mat3{});
  int translucent = 0;
  for (std::size_t i = 0; i + 1 < meshes.size(); ++i) {
    if (!meshes[i].IsTranslucent() || meshes[i].placed_model != meshes[i + 1].placed_model)
      continue;
    ++translucent;
    EXPECT_EQ(meshes[i].ambient_without, meshes[i + 1].ambient_with);
    EXPECT_EQ(meshes[i].ambient_with, meshes[i + 1].ambient_without);
  }
  EXPECT_EQ(translucent, 2);
}

TEST(TranslucentLight, OfAnOpaqueLeafIsThatOfAnyObject) {
  const UniformDay day({1e3, 1e3, 1e3}, {5e4, 5e4, 5e4}, {0.5, 0.2, 1.0});
  const auto opaque = MakeSolver({Object(Ground(0.5, {0.3F, 0.3F, 0.3F}))})->Solve(day, Mat3{});
  auto leaf = Ground(0.5, {0.3F, 0.3F, 0.3F});
  leaf->materials[0].detail.leaf.emplace();
  leaf->materials[0].detail.leaf->gloss = 0.0F;
  const auto lit = MakeSolver({Object(leaf)})->Solve(day, Mat3{});
  ASSERT_EQ(lit.size(), opaque.size());
  for (std::size_t i = 0; i < lit.size(); ++i) {
    EXPECT_EQ(lit[i].ambient_with, opaque[i].ambient_with);
    EXPECT_FALSE(lit[i].IsTranslucent());
  }
}

}  // namespace
}  // namespace pleinair::compositor
