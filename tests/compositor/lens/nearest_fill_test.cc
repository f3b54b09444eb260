#include "compositor/lens/nearest_fill.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pleinair::compositor {
namespace {

TEST(FillFromNearest, KeepsValidPixelsAndFillsHolesWithTheirSurroundings) {
  Image<float> values(37, 23, 2), weights(37, 23);
  for (int y = 0; y < 23; ++y) {
    for (int x = 0; x < 37; ++x) {
      const bool hole = std::hypot(x - 12, y - 11) < 6;
      weights(x, y) = hole ? 0.0F : 1.0F;
      values(x, y, 0) = hole ? 99.0F : 0.01F * x;
      values(x, y, 1) = hole ? -99.0F : 3.0F;
    }
  }
  const Image<float> filled = FillFromNearest(values, weights);
  for (int y = 0; y < 23; ++y) {
    for (int x = 0; x < 37; ++x) {
      EXPECT_NEAR(filled(x, y, 0), 0.01 * x, weights(x, y) > 0 ? 1e-6 : 0.06);
      EXPECT_NEAR(filled(x, y, 1), 3.0, 1e-5);
    }
  }
}

TEST(FillFromNearest, TakesTheNearerOfTwoColors) {
  Image<float> values(64, 1), weights(64, 1);
  values(0, 0) = 1.0F;
  weights(0, 0) = weights(63, 0) = 1.0F;
  const Image<float> filled = FillFromNearest(values, weights);
  EXPECT_GT(filled(8, 0), 0.7F);
  EXPECT_LT(filled(55, 0), 0.3F);
}

TEST(FillFromNearest, IsBlackWithoutAnyValidPixel) {
  Image<float> values(5, 4), weights(5, 4);
  values(2, 2) = 7.0F;
  const Image<float> filled = FillFromNearest(values, weights);
  for (std::size_t i = 0; i < filled.size(); ++i) EXPECT_EQ(filled.data()[i], 0.0F);
}

}  // namespace
}  // namespace pleinair::compositor
