#include "tracker/refinement/marker_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace pleinair::tracker {
namespace {

std::vector<MarkerResidual> Draw(const MarkerNoise& noise, double covered) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<MarkerResidual> residuals;
  for (int i = 0; i < 8000; ++i) {
    const double gain = i % 2 == 0 ? 0.0 : 20.0 + 180.0 * unit(random);
    const double codes = unit(random) < covered ? 150.0 * (unit(random) - 0.5)
                                                : std::sqrt(noise.Variance(gain)) * normal(random);
    residuals.push_back({codes, gain});
  }
  return residuals;
}

TEST(MarkerNoise, IsFoundAsItWasDrawn) {
  for (const MarkerNoise drawn : {MarkerNoise{1.5, 0.05}, MarkerNoise{3.0, 0.1}}) {
    const MarkerNoise found = EstimateMarkerNoise(Draw(drawn, 0.0));
    EXPECT_NEAR(found.flat_codes, drawn.flat_codes, 0.05 * drawn.flat_codes);
    EXPECT_NEAR(found.edge_share, drawn.edge_share, 0.15 * drawn.edge_share);
  }
}

TEST(MarkerNoise, LeavesEdgesNothingOfTheirOwnWhenAllPixelsAreAlike) {
  EXPECT_LT(EstimateMarkerNoise(Draw({4.0, 0.0}, 0.0)).edge_share, 0.01);
}

TEST(MarkerNoise, IsHardlyMovedWhenATenthIsCovered) {
  const MarkerNoise found = EstimateMarkerNoise(Draw({2.0, 0.06}, 0.1));
  EXPECT_NEAR(found.flat_codes, 2.0, 0.4);
  EXPECT_NEAR(found.edge_share, 0.06, 0.015);
}

TEST(MarkerNoise, IsThatOfRoundingWhereNothingIsLeftOver) {
  const MarkerNoise found = EstimateMarkerNoise(std::vector<MarkerResidual>(100));
  EXPECT_DOUBLE_EQ(found.flat_codes, 0.3);
  EXPECT_DOUBLE_EQ(found.edge_share, 0.0);
}

}  // namespace
}  // namespace pleinair::tracker
