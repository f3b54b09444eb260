#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "compositor/photometry/light_filter.h"
#include "compositor/photometry/sky_state.h"

namespace pleinair::compositor {
namespace {

using Source = MeasuredLight::Source;

UtcTime Minute(double minutes) { return UtcTime(0).PlusSeconds(60.0 * minutes); }

TEST(RandomWalkFilter, CombinesByInverseVariances) {
  RandomWalkFilter number(0.0);
  EXPECT_EQ(number.Add(1.0, 0.1, Minute(0)), 1.0) << "the first counts alone";
  EXPECT_NEAR(number.Add(1.3, 0.2, Minute(1)), 0.2, 1e-9);
  EXPECT_NEAR(number.value(), 1.06, 1e-9);
  EXPECT_NEAR(number.ErrorAt(Minute(1)), 0.1 * 0.2 / std::hypot(0.1, 0.2), 1e-9);
}

TEST(RandomWalkFilter, TrustsTheOldTheLessTheOlderItIs) {
  const auto weight = [](double minutes) {
    RandomWalkFilter number(0.1);
    number.Add(1.0, 0.1, Minute(10));
    return number.Add(1.2, 0.1, Minute(10 + minutes));
  };
  EXPECT_NEAR(weight(0), 1.0 / 2.0, 1e-9);
  EXPECT_NEAR(weight(1), 2.0 / 3.0, 1e-9);
  EXPECT_NEAR(weight(8), 9.0 / 10.0, 1e-9);
  EXPECT_NEAR(weight(-5), 1.0 / 2.0, 1e-9) << "a recording that begins again";
}

TEST(RandomWalkFilter, TakesWhatContradictsItInItsPlace) {
  RandomWalkFilter number(0.0);
  number.Add(1.0, 0.1, Minute(0));
  RandomWalkFilter other = number;
  const double limit = 3 * std::hypot(0.1, 0.1);
  EXPECT_LT(number.Add(1.0 + 0.99 * limit, 0.1, Minute(1)), 1.0);
  EXPECT_EQ(other.Add(1.0 - 1.01 * limit, 0.1, Minute(1)), 1.0);
  EXPECT_EQ(other.value(), 1.0 - 1.01 * limit);
  EXPECT_NEAR(other.ErrorAt(Minute(1)), 0.1, 1e-9);
}

TEST(LightFilter, LeavesToTheWordsWhatNoLookHasToldYet) {
  const LightFilter light_filter;
  EXPECT_FALSE(light_filter.Heading(Minute(0)));
  EXPECT_FALSE(light_filter.SkyBesideSun(Minute(0)));
  EXPECT_FALSE(light_filter.ObservedClouds());
  MeasuredLight light;
  SkyState skies;
  light_filter.Recall(Minute(0), &light, &skies);
  EXPECT_EQ(light.sun_source, Source::kDescription);
  EXPECT_EQ(skies.source, nullptr);
}

TEST(LightFilter, SmoothsNoise) {
  // Estimates of the same value, with errors on both sides.
  LightFilter light_filter;
  double worst_heading_deg = 0.0, worst_log = 0.0;
  for (int minute = 0; minute < 20; ++minute) {
    const double side = minute % 2 == 0 ? 1.0 : -1.0;
    light_filter.AddHeading({FromDegrees(-3.0 + 0.3 * side), FromDegrees(0.3)}, Minute(minute));
    const double sky = 1.5 * std::exp(0.15 * side);
    light_filter.AddSun({{sky, sky, 1.2 * sky}, 0.15}, Minute(minute));
    if (minute < 5) continue;
    worst_heading_deg =
        std::max(worst_heading_deg,
                 std::fabs(ToDegrees(light_filter.Heading(Minute(minute))->offset) + 3.0));
    const SkyRadianceScale known = *light_filter.SkyBesideSun(Minute(minute));
    worst_log = std::max(worst_log, std::fabs(std::log(known.scale.g / 1.5)));
    EXPECT_NEAR(known.scale.b, 1.2 * known.scale.g, 1e-9) << "a colour stays one";
    EXPECT_LT(known.relative_error, 0.12);
  }
  EXPECT_LT(worst_heading_deg, 0.15);
  EXPECT_LT(worst_log, 0.08);
}

TEST(LightFilter, KeepsALightThatIsNotSeenAgain) {
  LightFilter light_filter;
  light_filter.AddHeading({FromDegrees(-3.0), FromDegrees(0.2)}, Minute(0));
  light_filter.AddSun({{1.5, 1.4, 1.3}, 0.06}, Minute(0));
  MeasuredLight measured;
  measured.sun_source = Source::kShade;
  measured.evidence.shade_places = 7;
  measured.shaded = 0.3;
  light_filter.Keep(measured, {OvercastSky(), {1.5, 1.4, 1.3}});
  EXPECT_EQ(ToDegrees(light_filter.Heading(Minute(5))->offset), -3.0);
  EXPECT_NEAR(ToDegrees(light_filter.Heading(Minute(5))->error), std::sqrt(0.04 + 5 * 0.01), 1e-9);
  EXPECT_EQ(light_filter.SkyBesideSun(Minute(5))->scale, (LinearRgb{1.5, 1.4, 1.3}));
  MeasuredLight light;
  SkyState skies;
  light_filter.Recall(Minute(5), &light, &skies);
  EXPECT_EQ(light.sun_source, Source::kShade);
  EXPECT_EQ(light.evidence.shade_places, 7);
  EXPECT_EQ(light.shaded, 0.3);
  EXPECT_NEAR(light.sun_to_sky_error.value_or(0.0), std::hypot(0.06, 0.1 * std::sqrt(5.0)), 1e-9);
  EXPECT_EQ(skies.scale, (LinearRgb{1.5, 1.4, 1.3}));
}

TEST(LightFilter, FollowsTheWeatherWithinTwoLooks) {
  // Haze: less than a contradiction, and more.
  for (const double change : {1.2, 2.0}) {
    LightFilter light_filter;
    for (const int minute : {0, 1, 2}) light_filter.AddSun({{1.0, 1.0, 1.0}, 0.08}, Minute(minute));
    for (const int minute : {3, 4}) {
      light_filter.AddSun({{change, change, change}, 0.08}, Minute(minute));
    }
    EXPECT_NEAR(std::log(light_filter.SkyBesideSun(Minute(4))->scale.g), std::log(change), 0.03);
  }
}

TEST(LightFilter, TheNewestLookThatToldSaysWhetherTheSunShines) {
  LightFilter light_filter;
  light_filter.AddSun({{1.5, 1.5, 1.5}, 0.06}, Minute(0));
  light_filter.AddClouds();
  EXPECT_TRUE(light_filter.ObservedClouds());
  EXPECT_FALSE(light_filter.SkyBesideSun(Minute(1)));
  light_filter.AddSun({{1.5, 1.5, 1.5}, 0.06}, Minute(2));
  EXPECT_FALSE(light_filter.ObservedClouds());
  EXPECT_LT(light_filter.SkyBesideSun(Minute(2))->relative_error, 0.06)
      << "the sky was kept meanwhile";
}

}  // namespace
}  // namespace pleinair::compositor
