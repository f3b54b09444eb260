#include "base/units.h"

#include <numbers>
#include <type_traits>

#include <gtest/gtest.h>

#include "base/vector.h"

namespace pleinair {
namespace {

TEST(Units, DegreesAndRadiansConvertBothWays) {
  EXPECT_DOUBLE_EQ(FromDegrees(180.0).value(), std::numbers::pi);
  EXPECT_DOUBLE_EQ(ToDegrees(FromDegrees(342.0)), 342.0);
}

TEST(Units, DoNotMix) {
  EXPECT_FALSE((std::is_convertible_v<double, Radians>));
  EXPECT_FALSE((std::is_constructible_v<Lux, CandelaPerM2>));
  EXPECT_FALSE((std::is_assignable_v<Metres&, Radians>));
}

TEST(Units, RatioOfTwoIsAPlainNumber) {
  EXPECT_DOUBLE_EQ(Metres(3.0) / Metres(2.0), 1.5);
  EXPECT_EQ((Lux(2.0) + Lux(3.0)) * 2.0, Lux(10.0));
}

TEST(Vectors, CrossProductIsRightHanded) {
  EXPECT_EQ(Cross({1, 0, 0}, {0, 1, 0}), (Vec3{0, 0, 1}));
}

TEST(Vectors, LuminanceOfWhiteIsOne) { EXPECT_DOUBLE_EQ(Luminance({1, 1, 1}), 1.0); }

}  // namespace
}  // namespace pleinair
