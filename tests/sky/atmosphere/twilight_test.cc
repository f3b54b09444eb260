#include "sky/atmosphere/twilight.h"

#include <gtest/gtest.h>

namespace pleinair::sky {
namespace {

// Seidelmann 1992, Table 8.2: 759 lx at 0°, 3.4 lx at the end of civil twilight.
TEST(TwilightShare, FallsAsTheAlmanacSays) {
  EXPECT_EQ(TwilightShare(FromDegrees(1.0)), 1.0);
  EXPECT_EQ(TwilightShare(FromDegrees(0.0)), 1.0);
  EXPECT_NEAR(759.0 * TwilightShare(FromDegrees(-6.0)), 3.4, 0.1);
  EXPECT_NEAR(759.0 * TwilightShare(FromDegrees(-12.0)), 0.0081, 0.0005);
  EXPECT_EQ(TwilightShare(FromDegrees(-18.0)), TwilightShare(FromDegrees(-60.0)));
}

TEST(ComputedTwilight, IsTheRealOneUntilNineDegrees) {
  for (const double sun_deg : {60.0, 0.0, -6.0, -9.0}) {
    const double sun = sun_deg * kRadiansPerDegree;
    EXPECT_EQ(TwilightToCompute(sun).sun_elevation, sun);
    EXPECT_EQ(TwilightToCompute(sun).share, 1.0);
  }
}

TEST(ComputedTwilight, FallsFromNineDegreesToNothingAtEighteen) {
  double last = 1.0;
  for (int tenth = 91; tenth < 180; ++tenth) {
    const ComputedTwilight twilight = TwilightToCompute(-0.1 * tenth * kRadiansPerDegree);
    EXPECT_DOUBLE_EQ(twilight.sun_elevation, -9.0 * kRadiansPerDegree);
    EXPECT_LT(twilight.share, last);
    EXPECT_GT(twilight.share, 0.9 * last - 0.003);
    last = twilight.share;
  }
  EXPECT_NEAR(TwilightToCompute(-18.0 * kRadiansPerDegree).share, 0.0, 1e-12);
  EXPECT_NEAR(TwilightToCompute(-90.0 * kRadiansPerDegree).share, 0.0, 1e-12);
}

}  // namespace
}  // namespace pleinair::sky
