// What surfaces reflect where trees that no phantom stands for keep a part of the sun from them.
#include <gtest/gtest.h>

#include <vector>

#include "compositor/light_solver.h"
#include "compositor/seen_sunlight.h"
#include "tests/compositor/light_scenes.h"

namespace pleinair::compositor {
namespace {

using testing::BoxModel;
using testing::Ground;
using testing::Nearest;
using testing::Object;
using testing::Phantom;
using testing::UniformDay;

/// Light on the side of a box, over a few places.
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
    // One cell is the same everywhere.
    SeenSunlight map = MapSeenSunlight(day.ToSun().xyz, std::vector<SunlitSpot>{{{}, share, 0.1}});
    return MeanOnSide(solver->SolveUnderTrees(day, Mat3{}, map));
  };
  const float open = MeanOnSide(solver->Solve(day, Mat3{}));
  EXPECT_GT(open, 1e3F);
  EXPECT_EQ(on_side(1.0), open);
  // Land beyond the phantoms lies in the sun.
  const float land = on_side(0.0);
  EXPECT_LT(land, 0.15F * open);
  EXPECT_NEAR(on_side(0.5), 0.5 * (open + land), 0.03 * open);  // Rays' noise.
}

}  // namespace
}  // namespace pleinair::compositor
