// The time of exposure from simulated readings of blur.
#include "compositor/lens/exposure_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace pleinair::compositor {
namespace {

constexpr double kOwnBlur_px = 0.4, kInterval_s = 1.0 / 30.0;

struct Simulated {
  double exposure_s = 0.012;
  double fastest_px_s = 600.0;
  double common = 0.0;  ///< Further squared blur of all sides of a frame, over its squared speed.
  double nearest_m = 1.0, farthest_m = 1.1;
  double circle_px_m = 0.0;  ///< Diameter of the circle of confusion over 1/z.
  double direction = 0.3;    ///< The motion's, radians from the picture's right.
  double noise = 0.04, noise_px = 0.03;
  int frames = 40;
};

std::vector<BlurReading> Simulate(const Simulated& how, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<BlurReading> readings;
  readings.reserve(4 * static_cast<std::size_t>(how.frames));
  for (int i = 0; i < how.frames; ++i) {
    const double speed = how.fastest_px_s * std::fabs(std::sin(1.7 * i + 0.4));
    const double share = (i + 0.5) / how.frames;
    const double q = 1.0 / (how.farthest_m + share * (how.nearest_m - how.farthest_m));
    for (int side = 0; side < 4; ++side) {
      const double across =
          speed * (side % 2 == 0 ? std::sin(how.direction) : std::cos(how.direction));
      BlurReading reading;
      reading.frame_index = i;
      reading.timestamp_s = i * kInterval_s;
      reading.side = side;
      reading.dioptres = q;
      reading.dioptres_squared = q * q;
      reading.squared_speed = across * across;
      const double circle = how.circle_px_m * q / 4.0;
      const double blur = std::sqrt(kOwnBlur_px * kOwnBlur_px + circle * circle +
                                    across * across * how.exposure_s * how.exposure_s / 12.0 +
                                    how.common * speed * speed);
      reading.error_px = how.noise * blur + how.noise_px;
      reading.blur_px = blur + reading.error_px * normal(random);
      readings.push_back(reading);
    }
  }
  return readings;
}

TEST(ExposureFit, FindsTheExposureWithItsError) {
  for (const Simulated& how : {Simulated{}, Simulated{.exposure_s = 0.03, .fastest_px_s = 250.0},
                               Simulated{.nearest_m = 0.8, .farthest_m = 2.5, .circle_px_m = 3.0},
                               Simulated{.direction = 1.2}}) {
    constexpr int kTrials = 60;
    int measured = 0, within = 0;
    double squares = 0.0;
    for (int trial = 0; trial < kTrials; ++trial) {
      const ExposureFit fit = FitExposure(Simulate(how, 10U + trial), kInterval_s);
      if (!fit.is_measured()) continue;
      ++measured;
      const double off = fit.exposure_s - how.exposure_s;
      squares += off * off / (how.exposure_s * how.exposure_s);
      within += std::fabs(off) <= 2.0 * fit.error_s ? 1 : 0;
      EXPECT_NEAR(fit.still_blur_px, std::hypot(kOwnBlur_px, how.circle_px_m / 4.0), 0.5);
    }
    EXPECT_EQ(measured, kTrials);
    EXPECT_LT(std::sqrt(squares / measured), 0.05);
    EXPECT_GE(within, kTrials * 85 / 100);
  }
}

TEST(ExposureFit, InventsNoneWithoutMotionBlur) {
  for (int trial = 0; trial < 200; ++trial) {
    const ExposureFit fit = FitExposure(Simulate({.exposure_s = 0.0}, 10U + trial), kInterval_s);
    EXPECT_EQ(fit.reason, "the marker's edges blur no more where they move");
    EXPECT_GT(fit.shorter_than_s, 0.0);
    EXPECT_LT(fit.shorter_than_s, 0.006);
  }
  // A compression that blurs all of a frame the more, the faster the camera moves.
  for (int trial = 0; trial < 50; ++trial) {
    EXPECT_FALSE(
        FitExposure(Simulate({.exposure_s = 0.0, .common = 1e-5}, 10U + trial), kInterval_s)
            .is_measured());
  }
}

TEST(ExposureFit, RefusesWithAReason) {
  EXPECT_EQ(FitExposure({}, kInterval_s).reason,
            "too few edges of the marker are large and free enough to read their blur");
  EXPECT_EQ(FitExposure(Simulate({.fastest_px_s = 20.0}, 1), kInterval_s).reason,
            "the marker moves too slowly in the frames to be blurred by it");
  EXPECT_EQ(FitExposure(Simulate({.exposure_s = 0.05}, 1), kInterval_s).reason,
            "the blur by motion is longer than the time between two frames");
}

}  // namespace
}  // namespace pleinair::compositor
