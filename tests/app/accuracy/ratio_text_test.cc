#include "app/accuracy/ratio_text.h"

#include <gtest/gtest.h>

#include <limits>

namespace pleinair::app {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

TEST(RatioText, ReportsWhatTheDataDoNotBound) {
  EXPECT_EQ(RatioText(0.419, {0.38, 0.466}), "0.42 (0.38–0.47)");
  EXPECT_EQ(RatioText(28.571, {13.07, kInfinity}), "28.57 (13.07 or more)");
  EXPECT_EQ(RatioText(0.5, {kNone, kNone}), "0.50 (no interval)");
  EXPECT_EQ(RatioText(kInfinity, {kInfinity, kInfinity}), "unbounded");
  EXPECT_EQ(RatioText(kInfinity, {2.0, kInfinity}), "unbounded (2.00 or more)");
  EXPECT_EQ(RatioText(0.0, {0.0, 0.0}), "0.00 (0.00–0.00)");
  EXPECT_EQ(RatioText(kNone, {kNone, kNone}), "–");
}

}  // namespace
}  // namespace pleinair::app
