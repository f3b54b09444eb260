// Tests exposure estimates from a marker under leaves or with little sunlight beside a shadow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/srgb.h"
#include "compositor/photometry/marker/marker_light_meter.h"
#include "tests/compositor/photometry/marker/photographed_marker.h"

namespace pleinair::compositor {
namespace {

using testing::ExpectExposureScale;
using testing::kAmbientLux;
using testing::kCamera;
using testing::kExposureScale;
using testing::kFromAbove;
using testing::kSunLux;
using testing::MeterFor;
using testing::Photograph;

/// A marker under leaves that transmit between a quarter and all of the sun, without a shadow edge.
/// `blue`: share of that variation in the blue channel, as under a blue sky. `exposure`: factor on
/// kExposureScale; values are clipped at white.
RgbImage UnderLeaves(double blue, double* mean, double exposure = 1.0) {
  RgbImage picture = Photograph(kExposureScale, -1.0);
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const double leaves = std::sin(0.31 * x + 0.05 * y) * std::sin(0.23 * y - 0.08 * x);
      const double sun = std::clamp(0.7 + 0.45 * leaves, 0.25, 1.0);
      const double share = (kAmbientLux + sun * kSunLux) / (kAmbientLux + kSunLux);
      *mean += share / (picture.width() * picture.height());
      for (int c = 0; c < 3; ++c) {
        const double left = c == 2 ? 1.0 - blue * (1.0 - share) : share;
        const double linear = LinearFromSrgb8()[picture(x, y, c)] * left * exposure;
        picture(x, y, c) = Srgb8FromLinear(std::min(linear, 1.0));
      }
    }
  }
  return picture;
}

TEST(MarkerLightMeter, TakesTheBrightestSamplesUnderLeaves) {
  double mean = 0.0;
  const RgbImage picture = UnderLeaves(1.0, &mean);
  ASSERT_LT(mean, 0.8) << "the middle of the light is far below the sun";
  const auto estimate = MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove);
  ASSERT_TRUE(estimate);
  EXPECT_TRUE(estimate->dappled);
  EXPECT_FALSE(MeterFor(-1.0).FindShadow(picture.view(), kCamera, kFromAbove));
  EXPECT_GT(estimate->error.g, 0.10);
  EXPECT_NEAR(estimate->exposure_scale.r / kExposureScale.r, 1.0, 0.08);
  EXPECT_NEAR(estimate->exposure_scale.g / kExposureScale.g, 1.0, 0.08);
  EXPECT_NEAR(estimate->exposure_scale.b / kExposureScale.b, 1.0, 0.08);
}

TEST(MarkerLightMeter, TakesTheSameSamplesUnderLeavesForEachChannel) {
  // The variation is so small that the blue channel alone would count as evenly lit, at its mean.
  double mean = 0.0;
  const RgbImage picture = UnderLeaves(0.35, &mean);
  const auto estimate = MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove);
  ASSERT_TRUE(estimate);
  EXPECT_TRUE(estimate->dappled);
  EXPECT_LT(estimate->error.b, 0.10);
  EXPECT_GT(estimate->error.g, 0.10);
  const double bright_g = estimate->exposure_scale.g / kExposureScale.g;
  EXPECT_NEAR(estimate->exposure_scale.b / kExposureScale.b, 1.0 - 0.35 * (1.0 - bright_g), 0.02);
}

TEST(MarkerLightMeter, TakesTheSameSamplesUnderLeavesWhereOneChannelIsClipped) {
  double mean = 0.0;
  RgbImage picture = UnderLeaves(1.0, &mean);
  // 1.5 times as much red is clipped at the brightest samples, but not at most samples.
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const double red = 1.5 * LinearFromSrgb8()[picture(x, y, 0)];
      picture(x, y, 0) = Srgb8FromLinear(std::min(red, 1.0));
    }
  }
  const auto estimate = MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove);
  ASSERT_TRUE(estimate);
  ASSERT_TRUE(estimate->dappled);
  EXPECT_NEAR(estimate->exposure_scale.r / estimate->exposure_scale.g,
              1.5 * kExposureScale.r / kExposureScale.g, 0.03);
  EXPECT_NEAR(estimate->exposure_scale.b / estimate->exposure_scale.g,
              kExposureScale.b / kExposureScale.g, 0.03);
}

TEST(MarkerLightMeter, ReadsTheSunUnderLeavesWhereItClipsEvenMostOfTheMarker) {
  // White clips wherever more than half of the sun arrives: most remaining samples are half-lit.
  for (const double exposure : {1.6, 2.2}) {
    double mean = 0.0;
    const RgbImage picture = UnderLeaves(1.0, &mean, exposure);
    const auto estimate = MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove);
    ASSERT_TRUE(estimate);
    EXPECT_TRUE(estimate->dappled);
    EXPECT_NEAR(estimate->exposure_scale.r / (exposure * kExposureScale.r), 1.0, 0.1) << exposure;
    EXPECT_NEAR(estimate->exposure_scale.g / (exposure * kExposureScale.g), 1.0, 0.1) << exposure;
    EXPECT_NEAR(estimate->exposure_scale.b / (exposure * kExposureScale.b), 1.0, 0.1) << exposure;
  }
}

/// Phantoms leave the marker's right side sunlit. An unmodelled shadow leaves of that side only a
/// strip of width `sunlit_m`. `half_light`: share of the light at the strip's ends; its centre is
/// fully lit.
RgbImage SunlitStrip(double sunlit_m, double half_light) {
  RgbImage picture = Photograph(kExposureScale, 1.0);
  const RgbImage sunlit = Photograph(kExposureScale, -1.0);
  const int half = static_cast<int>(sunlit_m / 2 * kCamera.fy);
  for (int y = 120 - half; y <= 120 + half; ++y) {
    const double left = 1.0 - (1.0 - half_light) * std::abs(y - 120) / half;
    for (int x = 0; x < picture.width(); ++x) {
      for (int c = 0; c < 3; ++c) {
        picture(x, y, c) = Srgb8FromLinear(left * LinearFromSrgb8()[sunlit(x, y, c)]);
      }
    }
  }
  return picture;
}

constexpr double kStripFromX_m = 0.17;

TEST(MarkerLightMeter, ReadsTheSunOffTheFewSamplesThatAShadowLeavesIt) {
  const RgbImage picture = SunlitStrip(0.06, 1.0);
  const auto estimate = MeterFor(kStripFromX_m).Measure(picture.view(), kCamera, kFromAbove);
  ExpectExposureScale(estimate, kExposureScale);
  EXPECT_LT(estimate->pairs, MarkerLightMeter::kMinimumPairs);
  EXPECT_FALSE(estimate->dappled) << "a sharp edge and one level are no leaves";
}

TEST(MarkerLightMeter, TakesAFewSamplesOfUnevenLightForASampleBetweenLeaves) {
  const RgbImage picture = SunlitStrip(0.06, 0.5);
  const auto estimate = MeterFor(kStripFromX_m).Measure(picture.view(), kCamera, kFromAbove);
  ASSERT_TRUE(estimate);
  EXPECT_LT(estimate->pairs, MarkerLightMeter::kMinimumPairs);
  EXPECT_TRUE(estimate->dappled);
  EXPECT_GT(estimate->error.g, 0.1);
}

TEST(MarkerLightMeter, ReportsNothingWhereAShadowLeavesFewerThanSixSamplesInTheSun) {
  // Half of the right side's pairs are covered, so that a few pairs suffice for a level.
  const auto measure = [](double sunlit_m) {
    RgbImage picture = SunlitStrip(sunlit_m, 1.0);
    for (int y = 0; y < 114; ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        for (int c = 0; c < 3; ++c) picture(x, y, c) = 90;
      }
    }
    return MeterFor(kStripFromX_m).Measure(picture.view(), kCamera, kFromAbove);
  };
  EXPECT_FALSE(measure(0.026));
  ExpectExposureScale(measure(0.06), kExposureScale);
}

TEST(MarkerLightMeter, ChangesLittleWhereLeavesBeginToShow) {
  double before = 0.0;
  bool even = false, dappled = false;
  for (int step = 10; step <= 60; ++step) {
    RgbImage picture = Photograph(kExposureScale, -1.0);
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const double leaves = std::sin(0.31 * x + 0.05 * y) * std::sin(0.23 * y - 0.08 * x);
        const double share = 1.0 - 0.005 * step * (1.0 - leaves);
        for (int c = 0; c < 3; ++c) {
          picture(x, y, c) = Srgb8FromLinear(LinearFromSrgb8()[picture(x, y, c)] * share);
        }
      }
    }
    const auto estimate = MeterFor(-1.0).Measure(picture.view(), kCamera, kFromAbove);
    ASSERT_TRUE(estimate);
    (estimate->dappled ? dappled : even) = true;
    if (step > 10) {
      EXPECT_NEAR(estimate->exposure_scale.g / before, 1.0, 0.03) << step;
    }
    before = estimate->exposure_scale.g;
  }
  EXPECT_TRUE(even && dappled);
}

}  // namespace
}  // namespace pleinair::compositor
