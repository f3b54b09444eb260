// Focus and aperture from simulated readings of blur.
#include "compositor/lens/focus_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace pleinair::compositor {
namespace {

constexpr double kFx = 605.0, kAperture_m = 0.012, kFocus_m = 1.6, kOwnBlur_px = 0.3;

struct Simulated {
  double nearest_m = 1.0, farthest_m = 4.0;
  double aperture_m = kAperture_m, focus_dioptres = 1.0 / kFocus_m;
  double noise = 0.04, noise_px = 0.03;
  int readings = 60;
};

/// Readings of a print that comes nearer, with the noise of the specification.
std::vector<BlurReading> Simulate(const Simulated& how, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<BlurReading> readings;
  readings.reserve(static_cast<std::size_t>(how.readings));
  for (int i = 0; i < how.readings; ++i) {
    const double share = (i + 0.5) / how.readings;
    const double q = 1.0 / (how.farthest_m + share * (how.nearest_m - how.farthest_m));
    BlurReading reading;
    reading.frame_index = i / 4;
    reading.timestamp_s = static_cast<double>(reading.frame_index) / 30.0;
    reading.side = i % 4;
    reading.dioptres = q;
    reading.dioptres_squared = q * q;
    const double blur =
        std::hypot(kOwnBlur_px, kFx * how.aperture_m / 4.0 * (q - how.focus_dioptres));
    reading.error_px = how.noise * blur + how.noise_px;
    reading.blur_px = blur + reading.error_px * normal(random);
    readings.push_back(reading);
  }
  return readings;
}

struct Trials {
  double aperture_rms = 0.0, focus_rms = 0.0;  // Relative; 1/m.
  int measured = 0, aperture_within = 0, focus_within = 0;
};

Trials Try(const Simulated& how, int trials, const KnownLens& known = {}) {
  Trials tried;
  for (int i = 0; i < trials; ++i) {
    const FocusFit fit = FitFocus(Simulate(how, 100 + i), kFx, known);
    if (!fit.is_measured()) continue;
    ++tried.measured;
    const double aperture_off = fit.aperture_m / how.aperture_m - 1.0;
    const double focus_off = fit.focus_dioptres - how.focus_dioptres;
    tried.aperture_rms += aperture_off * aperture_off;
    tried.focus_rms += focus_off * focus_off;
    tried.aperture_within += std::fabs(aperture_off) <= 2.0 * fit.aperture_relative_error ? 1 : 0;
    tried.focus_within += std::fabs(focus_off) <= 2.0 * fit.focus_dioptres_error ? 1 : 0;
  }
  tried.aperture_rms = std::sqrt(tried.aperture_rms / std::max(1, tried.measured));
  tried.focus_rms = std::sqrt(tried.focus_rms / std::max(1, tried.measured));
  return tried;
}

TEST(FocusFit, ReadsFocusAndApertureAsSurelyAsItSays) {
  const Trials wide = Try({}, 400);
  EXPECT_GE(wide.measured, 396);
  EXPECT_LT(wide.aperture_rms, 0.034);
  EXPECT_LT(wide.focus_rms, 0.008);
  EXPECT_GE(wide.aperture_within, wide.measured * 95 / 100);
  EXPECT_GE(wide.focus_within, wide.measured * 95 / 100);

  const Trials narrow = Try({.nearest_m = 1.2, .farthest_m = 2.6}, 400);
  EXPECT_GE(narrow.measured, 380);
  EXPECT_LT(narrow.aperture_rms, 0.060);
  EXPECT_LT(narrow.focus_rms, 0.009);
  EXPECT_GE(narrow.aperture_within, narrow.measured * 95 / 100);
  EXPECT_GE(narrow.focus_within, narrow.measured * 95 / 100);
}

TEST(FocusFit, UsesWhatIsKnownOfTheLens) {
  const Simulated how{.nearest_m = 1.2, .farthest_m = 2.6};
  const Trials free = Try(how, 200);
  const Trials aperture = Try(how, 200, {.aperture_m = kAperture_m});
  EXPECT_EQ(aperture.measured, 200);
  EXPECT_NEAR(aperture.aperture_rms, 0.0, 1e-9);
  EXPECT_LT(aperture.focus_rms, free.focus_rms);
  const Trials focus = Try(how, 200, {.focus_dioptres = 1.0 / kFocus_m});
  EXPECT_NEAR(focus.focus_rms, 0.0, 1e-9);
  EXPECT_LT(focus.aperture_rms, 1.05 * free.aperture_rms);
}

TEST(FocusFit, FindsAFocusAtInfinity) {
  const FocusFit fit =
      FitFocus(Simulate({.nearest_m = 0.7, .farthest_m = 6.0, .focus_dioptres = 0.0}, 3), kFx);
  ASSERT_TRUE(fit.is_measured()) << fit.reason;
  EXPECT_NEAR(fit.focus_dioptres, 0.0, 0.03);
  EXPECT_GE(fit.focus_dioptres, 0.0);
}

TEST(FocusFit, DeclinesWhereTheDistanceSaysTooLittle) {
  EXPECT_EQ(Try({.nearest_m = 1.5, .farthest_m = 2.0}, 400).measured, 0);
  EXPECT_EQ(Try({.nearest_m = 1.99, .farthest_m = 2.0}, 400).measured, 0);
  // A pinhole.
  EXPECT_EQ(Try({.aperture_m = 0.0}, 400).measured, 0);
  const FocusFit few = FitFocus(Simulate({.readings = 8}, 1), kFx);
  EXPECT_EQ(few.reason, "too few edges of the marker are large and free enough to read their blur");
  const FocusFit still = FitFocus(Simulate({.nearest_m = 2.0, .farthest_m = 2.1}, 1), kFx);
  EXPECT_EQ(still.reason, "the marker's distance hardly changes");
}

TEST(FocusFit, ReadsTheExposureFromEdgesAcrossTheMotion) {
  constexpr double kExposure_s = 0.012, kSpeed = 250.0;
  std::vector<BlurReading> readings = Simulate({.noise = 0.02, .noise_px = 0.01}, 5);
  for (BlurReading& reading : readings) {
    // Along the picture's rows: sides 1 and 3 stand across it.
    if (reading.side % 2 == 0) continue;
    const double speed = kSpeed * (1.0 + 0.3 * std::sin(reading.frame_index));
    reading.squared_speed = speed * speed;
    reading.blur_px = std::hypot(reading.blur_px, speed * kExposure_s / std::sqrt(12.0));
  }
  const FocusFit fit = FitFocus(readings, kFx);
  ASSERT_TRUE(fit.is_measured()) << fit.reason;
  EXPECT_NEAR(fit.exposure_s, kExposure_s, 0.1 * kExposure_s);
  EXPECT_NEAR(fit.aperture_m, kAperture_m, 0.06 * kAperture_m);
  // With the exposure known, nothing of it is fitted.
  EXPECT_NEAR(FitFocus(readings, kFx, {.exposure_s = kExposure_s}).exposure_s, kExposure_s, 1e-9);
  // Where poses do not show the motion, its sides are left out.
  for (BlurReading& reading : readings) reading.squared_speed = 0.0;
  const FocusFit unseen = FitFocus(readings, kFx);
  EXPECT_LT(unseen.readings, 45U);
  ASSERT_TRUE(unseen.is_measured()) << unseen.reason;
  EXPECT_NEAR(unseen.aperture_m, kAperture_m, 0.1 * kAperture_m);
}

TEST(FocusFit, FollowsAFocusThatSteps) {
  // Towards the marker and away again, with another focus on the way back.
  std::vector<BlurReading> readings =
      Simulate({.noise = 0.02, .noise_px = 0.01, .readings = 480}, 1);
  std::vector<BlurReading> back =
      Simulate({.focus_dioptres = 0.75, .noise = 0.02, .noise_px = 0.01, .readings = 480}, 2);
  for (BlurReading& reading : readings) reading.timestamp_s *= 2.0;
  for (std::size_t i = back.size(); i-- > 0;) {
    BlurReading reading = back[i];
    const auto frame = static_cast<std::int64_t>((back.size() - 1 - i) / 4);
    reading.frame_index = 120 + frame;
    reading.timestamp_s = static_cast<double>(120 + frame) / 15.0;
    readings.push_back(reading);
  }
  const FocusFit fit = FitFocus(readings, kFx);
  ASSERT_TRUE(fit.is_measured()) << fit.reason;
  ASSERT_GE(fit.changes.size(), 7U);
  EXPECT_NEAR(fit.changes[1].focus_dioptres, 1.0 / kFocus_m, 0.03);
  EXPECT_NEAR(fit.changes[fit.changes.size() - 2].focus_dioptres, 0.75, 0.03);
  EXPECT_TRUE(FitFocus(Simulate({.readings = 480}, 1), kFx).changes.empty());
}

}  // namespace
}  // namespace pleinair::compositor
