// Motion blur as replay draws it against rays from a moving camera.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "app/bench/defocus_bench.h"

namespace pleinair::app {
namespace {

TEST(MotionBench, DrawsMotionAsTracedRaysShowIt) {
  const std::vector<std::string> names{"shake", "dolly", "both"};
  PictureBench bench{
      .scenes = names, .methods = {"moved", "pinhole"}, .width = 96, .height = 72, .rounds = 1};
  std::map<std::string, DefocusBenchRow> moved, still;
  const auto run = RunDefocusBench(bench, {[] {},
                                           [&](const DefocusBenchRow& row) {
                                             (row.method == "moved" ? moved : still)[row.scene] =
                                                 row;
                                           },
                                           {}});
  ASSERT_TRUE(run) << run.error().Message();
  ASSERT_EQ(moved.size(), names.size());
  constexpr double kContrast = 0.8;
  for (const auto& [scene, row] : moved) {
    EXPECT_LT(row.edge_rmse, 0.015 * kContrast) << scene;
    EXPECT_GT(still[scene].edge_rmse, 4.0 * row.edge_rmse) << scene;
    EXPECT_GE(row.views, 5) << scene;
    EXPECT_LE(row.views, 64) << scene;
  }
}

}  // namespace
}  // namespace pleinair::app
