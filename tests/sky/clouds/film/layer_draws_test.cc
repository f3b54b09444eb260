// Uncertainty of what a course shows of a layer.
#include "sky/clouds/film/layer_draws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "sky/clouds/cloud_field.h"
#include "tests/sky/clouds/film/made_film.h"

namespace pleinair::clouds {
namespace {

// Layers of other seeds, covers, depths and winds than those of the draws. Among 96 courses 65 are
// expected within the range of 68 %. Were all courses independent, 3 deviations would be 0.14.
TEST(LayerDraws, StateAnUncertaintyThatHolds) {
  const Direction<World> to_sun = testing::SunAbove(160.0, 45.0);
  const LayerDraws draws(CloudKind::kCumulus, to_sun, std::nullopt, 0.02);
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> unit;
  int covers = 0, cells = 0, courses = 0;
  double widest = 0.0, narrowest = 1.0, off = 0.0;
  for (int l = 0; l < 12; ++l) {
    CloudLayer layer = ParseCloudLayer("kind=cumulus").value();
    layer.cover = 0.05 + 0.9 * unit(engine);
    layer.optical_depth = 6.0 * std::pow(10.0, unit(engine));
    layer.seed = 77'000 + l;
    const CloudField field(layer);
    for (int c = 0; c < 8; ++c) {
      const double passing = 0.3 * std::pow(60.0, unit(engine)), azimuth = 6.28 * unit(engine);
      const Vec3 start{20'000.0 * unit(engine), 20'000.0 * unit(engine), 0.0};
      std::vector<double> sun;
      sun.reserve(kCourseSamples);
      for (int i = 0; i < kCourseSamples; ++i) {
        const double along = passing * layer.cell_m * i / (kCourseSamples - 1);
        const Vec3 at = start + Vec3{std::sin(azimuth), std::cos(azimuth), 0.0} * along;
        sun.push_back(std::exp(-field.DepthAlong(at, to_sun.xyz, 0.0)));
      }
      const LayerPosterior found = draws.Posterior(NumbersOf(sun));
      ++courses;
      covers += found.cover.low <= layer.cover && layer.cover <= found.cover.high;
      cells += found.cells.low <= passing && passing <= found.cells.high;
      widest = std::max(widest, found.cover.high - found.cover.low);
      narrowest = std::min(narrowest, found.cover.high - found.cover.low);
      off += std::fabs(found.cover.value - layer.cover);
    }
  }
  RecordProperty("covers_within", covers);
  RecordProperty("cells_within", cells);
  EXPECT_NEAR(covers / static_cast<double>(courses), 0.68, 0.15);
  EXPECT_NEAR(cells / static_cast<double>(courses), 0.68, 0.15);
  // Long films tell more than short ones. A guess of a half would be off by 0.23.
  EXPECT_GT(widest, 1.5 * narrowest);
  EXPECT_LT(off / courses, 0.19);
}

}  // namespace
}  // namespace pleinair::clouds
