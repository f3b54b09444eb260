#include "compositor/lens/thin_lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace pleinair::compositor {
namespace {

/// The paper's Eq. 1: diameter on the sensor, metres.
double OnSensor_m(double f_m, double f_number, double focus_m, double z_m) {
  return std::fabs(f_m * f_m * (z_m - focus_m) / (z_m * f_number * (focus_m - f_m)));
}

TEST(ThinLens, HasThePapersCirclesOfATelephone) {
  const ThinLens lens{4.25e-3 / 1.8, 1.0 / 0.6};
  EXPECT_NEAR(CircleOfConfusion_px(lens, 3000, 0.3), 11.806, 5e-4);
  EXPECT_NEAR(CircleOfConfusion_px(lens, 3000, 2.0), 8.264, 5e-4);
  EXPECT_NEAR(CircleOfConfusion_px(lens, 3000, 10.0), 11.097, 5e-4);
  EXPECT_EQ(CircleOfConfusion_px(lens, 3000, 0.6), 0.0);
}

TEST(ThinLens, AgreesWithTheCircleOnTheSensor) {
  const double f_m = 0.1, f_number = 1.4, focus_m = 18.5, pitch_m = 8e-6;
  EXPECT_NEAR(OnSensor_m(f_m, f_number, focus_m, 5), 1.0481e-3, 5e-8);
  EXPECT_NEAR(OnSensor_m(f_m, f_number, focus_m, 40), 2.0866e-4, 5e-9);
  const double image_distance_m = f_m * focus_m / (focus_m - f_m);
  const ThinLens lens{f_m / f_number, 1.0 / focus_m};
  for (const double z_m : {0.5, 5.0, 18.5, 40.0, 1e6}) {
    EXPECT_NEAR(CircleOfConfusion_px(lens, image_distance_m / pitch_m, z_m),
                OnSensor_m(f_m, f_number, focus_m, z_m) / pitch_m, 1e-8);
  }
}

TEST(ThinLens, InvertsItsCircles) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.01, 0.99), aperture(1e-3, 5e-2), dioptres(0.05, 3);
  for (int i = 0; i < 1000; ++i) {
    const ThinLens lens{aperture(random), dioptres(random)};
    const double fx = 600, infinite_px = fx * lens.aperture_m * lens.focus_dioptres;
    const double d = share(random) * infinite_px;
    const double before = DistanceBeforeFocus_m(lens, fx, d);
    const double behind = DistanceBehindFocus_m(lens, fx, d);
    EXPECT_LT(before, 1.0 / lens.focus_dioptres);
    EXPECT_GT(behind, 1.0 / lens.focus_dioptres);
    EXPECT_NEAR(CircleOfConfusion_px(lens, fx, before), d, 1e-9 * infinite_px);
    EXPECT_NEAR(CircleOfConfusion_px(lens, fx, behind), d, 1e-9 * infinite_px);
    EXPECT_EQ(DistanceBehindFocus_m(lens, fx, 1.001 * infinite_px),
              std::numeric_limits<double>::infinity());
  }
  // The paper's Eq. 8.
  const double limit_m = 0.1 * 0.1 / (1.4 * (18.5 - 0.1));
  EXPECT_NEAR(limit_m, 3.882e-4, 5e-8);
}

TEST(ThinLens, MayBeFocusedOnInfinity) {
  const ThinLens lens{0.01, 0.0};
  EXPECT_NEAR(CircleOfConfusion_px(lens, 1000, 2.0), 5.0, 1e-12);
  EXPECT_EQ(CircleOfConfusion_px(lens, 1000, std::numeric_limits<double>::infinity()), 0.0);
}

}  // namespace
}  // namespace pleinair::compositor
