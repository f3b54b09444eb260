// Tests reflected light where unmodelled trees keep part of the sun from surfaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "compositor/light/light_solver.h"
#include "compositor/light/sun_transmittance_map.h"
#include "tests/compositor/light/light_scenes.h"

namespace pleinair::compositor {
namespace {

using testing::BoxModel;
using testing::Ground;
using testing::Nearest;
using testing::Object;
using testing::Phantom;
using testing::UniformDay;

/// Light on the side of a box, at a few points.
float MeanOnSide(const std::vector<LitMesh>& meshes) {
  float sum = 0.0F;
  for (const double y : {-0.15, -0.05, 0.05, 0.15}) {
    for (const double z : {0.2, 0.3, 0.4, 0.5}) {
      sum += Nearest(meshes, {0.2, y, z}, {1, 0, 0}).with[1];
    }
  }
  return sum / 16;
}

TEST(LightUnderTrees, SendsBackFromTheGroundTheSunThatTreesLeaveIt) {
  const auto solver =
      *LightSolver::Create({Phantom(Ground(4.0, {0.3F, 0.3F, 0.3F})),
                            Object(BoxModel({-0.2, -0.2, 0.0}, {0.2, 0.2, 0.6}, {}))},
                           {.near_edge_m = 0.1});
  const UniformDay day({0, 0, 0}, {60e3, 60e3, 60e3}, {0.3, 0.2, 1});
  const auto on_side = [&](double share) {
    // A single cell is uniform.
    SunTransmittanceMap map =
        BuildSunTransmittanceMap(day.ToSun().xyz, std::vector<SunlitSample>{{{}, share, 0.1}});
    return MeanOnSide(solver->SolveUnderTrees(day, Mat3{}, map));
  };
  const float open = MeanOnSide(solver->Solve(day, Mat3{}));
  EXPECT_GT(open, 1e3F);
  EXPECT_EQ(on_side(1.0), open);
  // Land beyond the phantoms is sunlit.
  const float land = on_side(0.0);
  EXPECT_LT(land, 0.15F * open);
  EXPECT_NEAR(on_side(0.5), 0.5 * (open + land), 0.03 * open);  // Ray noise.
}

TEST(LightUnderTrees, IsEvenBetweenSamplesThatLieFarApart) {
  // At grazing angles there are fewer surface samples along the line of sight than cells of the
  // map. Sunlight that grows across the samples must also grow between them.
  const auto share = [](Vec3 at) { return 0.5 + 0.4 * at.y; };
  std::vector<SunlitSample> surface_samples;
  for (int i = 0; i < 100; ++i) {
    for (int j = 0; j <= 25; ++j) {
      const Vec3 at{-1.0 + 0.02 * i, -1.0 + 0.08 * j, 0.0};
      surface_samples.push_back({at, share(at), 0.01});
    }
  }
  const SunTransmittanceMap map = BuildSunTransmittanceMap({0, 0, 1}, surface_samples);
  ASSERT_NEAR(map.cell_m, 0.02, 1e-9);
  double farthest = 0.0;
  for (int i = 0; i < 140; ++i) {
    const Vec3 at{0.013, -0.7 + 0.01 * i, 0.0};
    farthest = std::max(farthest, std::fabs(map.At(at) - share(at)));
  }
  EXPECT_LT(farthest, 0.02);  // One row of surface samples differs from the next by 0.032.
}

}  // namespace
}  // namespace pleinair::compositor
