#include "base/srgb.h"

#include <gtest/gtest.h>

namespace pleinair {
namespace {

// IEC 61966-2-1 worked by hand: ((188/255 + 0.055)/1.055)^2.4 and its neighbours.
TEST(Srgb, GivesPublishedValues) {
  EXPECT_NEAR(LinearFromSrgb(0.5), 0.21404114, 1e-8);
  EXPECT_NEAR(SrgbFromLinear(0.18), 0.46135612, 1e-8);
  EXPECT_NEAR(LinearFromSrgb(10.0 / 255.0), 0.00303527, 1e-8);
  EXPECT_EQ(Srgb8FromLinear(0.5), 188);
  EXPECT_EQ(Srgb8FromLinear(0.18), 118);
}

TEST(Srgb, BranchesMeetAtTheKnee) {
  EXPECT_NEAR(LinearFromSrgb(0.04045), LinearFromSrgb(0.04045 + 1e-9), 1e-7);
  EXPECT_NEAR(SrgbFromLinear(0.0031308), SrgbFromLinear(0.0031308 + 1e-9), 1e-6);
}

TEST(Srgb, EveryCodeSurvivesTheWayToLinearLightAndBack) {
  for (int code = 0; code < 256; ++code) {
    EXPECT_EQ(Srgb8FromLinear(LinearFromSrgb(code / 255.0)), code);
    EXPECT_EQ(Srgb8FromLinear(LinearFromSrgb8()[code]), code);
  }
}

TEST(Srgb, ClipsWhatNoCodeCanShow) {
  EXPECT_EQ(Srgb8FromLinear(-0.5), 0);
  EXPECT_EQ(Srgb8FromLinear(7.0), 255);
}

}  // namespace
}  // namespace pleinair
