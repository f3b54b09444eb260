#include "compositor/photometry/exposure_filter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pleinair::compositor {
namespace {

constexpr LinearRgb kExposureScale{0.002, 0.001, 0.003};
constexpr LinearRgb kError{0.01, 0.02, 0.03};  // Relative error of each exposure estimate.

void Add(int count, const LinearRgb& exposure_scale, ExposureFilter* filter) {
  for (int i = 0; i < count; ++i) filter->Add(exposure_scale, kError);
}

TEST(ExposureFilter, KeepsTheMedianOfTheLastFifteenReadings) {
  ExposureFilter filter;
  EXPECT_TRUE(filter.empty());
  filter.Add(kExposureScale, kError);
  EXPECT_FALSE(filter.empty());
  EXPECT_DOUBLE_EQ(filter.ExposureScale().r, kExposureScale.r);
  Add(14, kExposureScale, &filter);
  Add(7, kExposureScale * 2.0, &filter);
  EXPECT_DOUBLE_EQ(filter.ExposureScale().g, kExposureScale.g);
  Add(1, kExposureScale * 2.0, &filter);
  EXPECT_DOUBLE_EQ(filter.ExposureScale().g, 2.0 * kExposureScale.g);
}

TEST(ExposureFilter, TakesEachChannelByItself) {
  ExposureFilter filter;
  filter.Add({3.0, 1.0, 2.0}, kError);
  filter.Add({1.0, 2.0, 3.0}, kError);
  filter.Add({2.0, 3.0, 1.0}, kError);
  EXPECT_DOUBLE_EQ(filter.ExposureScale().r, 2.0);
  EXPECT_DOUBLE_EQ(filter.ExposureScale().g, 2.0);
  EXPECT_DOUBLE_EQ(filter.ExposureScale().b, 2.0);
}

TEST(ExposureFilter, EstimatesHowMuchTheExposureChanged) {
  ExposureFilter filter;
  EXPECT_DOUBLE_EQ(filter.Change(), 1.0);
  Add(5, kExposureScale, &filter);
  EXPECT_DOUBLE_EQ(filter.Change(), 1.0);
  // Three of five estimates have the new light, in the channel that changed most; and back again.
  Add(3, {kExposureScale.r, kExposureScale.g / 2.5, kExposureScale.b * 1.5}, &filter);
  EXPECT_NEAR(filter.Change(), 2.5, 1e-12);
  Add(20, kExposureScale, &filter);
  EXPECT_NEAR(filter.Change(), 2.5, 1e-12);
}

TEST(ExposureFilter, IsNotMisledByAHandOrAHighlight) {
  ExposureFilter filter;
  for (int i = 0; i < 10; ++i) {
    Add(2, kExposureScale * (i % 2 == 0 ? 4.0 : 0.1), &filter);
    Add(3, kExposureScale, &filter);
  }
  EXPECT_DOUBLE_EQ(filter.Change(), 1.0);
  EXPECT_DOUBLE_EQ(filter.ExposureScale().b, kExposureScale.b);
}

TEST(ExposureFilter, EstimatesHowCertainItsMedianIs) {
  ExposureFilter filter;
  Add(1, kExposureScale, &filter);
  EXPECT_DOUBLE_EQ(filter.Error().r, kError.r) << "a single reading's own";
  Add(14, kExposureScale, &filter);
  EXPECT_DOUBLE_EQ(filter.Error().g, kError.g) << "frames share what is wrong of a print";
  // Five of fifteen are 8 % higher and five 8 % lower: a median deviation of 8 % in green alone.
  ExposureFilter scattered;
  for (int i = 0; i < 5; ++i) {
    for (const double off : {0.92, 1.0, 1.08}) {
      scattered.Add({kExposureScale.r, kExposureScale.g * off, kExposureScale.b}, kError);
    }
  }
  EXPECT_DOUBLE_EQ(scattered.Error().r, kError.r);
  const double among = 0.08 * 1.4826 * 1.2533 / std::sqrt(15.0);
  EXPECT_NEAR(scattered.Error().g, std::hypot(kError.g, among), 1e-6);
}

}  // namespace
}  // namespace pleinair::compositor
