#include "shadows/splits.h"

#include <gtest/gtest.h>

namespace pleinair::shadows {
namespace {

// n = 1, f = 1000, m = 4: Kolivand & Sunar 2014, Eqs. 11–13 evaluated with i/m in Eq. 12.
TEST(PracticalSplits, GiveThePublishedValues) {
  const std::vector<double> practical = PracticalSplits(1.0, 1000.0, 4, 0.5);
  ASSERT_EQ(practical.size(), 5U);
  EXPECT_EQ(practical.front(), 1.0);
  EXPECT_NEAR(practical[1], 128.19, 0.005);
  EXPECT_NEAR(practical[2], 266.06, 0.005);
  EXPECT_NEAR(practical[3], 464.04, 0.005);
  EXPECT_EQ(practical.back(), 1000.0);
  const std::vector<double> logarithmic = PracticalSplits(1.0, 1000.0, 4, 1.0);
  EXPECT_NEAR(logarithmic[1], 5.62, 0.005);
  EXPECT_NEAR(logarithmic[2], 31.6, 0.05);
  EXPECT_NEAR(logarithmic[3], 177.8, 0.05);
  const std::vector<double> uniform = PracticalSplits(1.0, 1000.0, 4, 0.0);
  EXPECT_DOUBLE_EQ(uniform[1], 250.75);
  EXPECT_DOUBLE_EQ(uniform[3], 750.25);
}

TEST(PracticalSplits, OfOnePartitionAreTheEnds) {
  EXPECT_EQ(PracticalSplits(0.5, 20.0, 1, 0.5), (std::vector<double>{0.5, 20.0}));
}

}  // namespace
}  // namespace pleinair::shadows
