#include "compositor/photometry/marker/marker_shade.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pleinair::compositor {
namespace {

// On level ground, warm and blue.
constexpr LinearRgb kSun{50e3, 45e3, 36e3}, kSky{10e3, 13e3, 18e3};

LinearRgb OpenOver(double part) { return (kSun + kSky) / (kSun * part + kSky); }

void ExpectNear(LinearRgb value, LinearRgb expected) {
  EXPECT_NEAR(value.r / expected.r, 1.0, 1e-3);
  EXPECT_NEAR(value.g / expected.g, 1.0, 1e-3);
  EXPECT_NEAR(value.b / expected.b, 1.0, 1e-3);
}

TEST(MarkerShadeCorrection, IsThatOfAMarkerWithAPartOfTheSun) {
  for (const double part : {0.0, 0.1, 0.5, 0.9}) {
    ExpectNear(MarkerShadeCorrection(std::exp(MeanLog(OpenOver(part))), kSun, kSky),
               OpenOver(part));
  }
}

TEST(MarkerShadeCorrection, IsBluerThanTheOpen) {
  const LinearRgb shade = MarkerShadeCorrection(2.0, kSun, kSky);
  EXPECT_GT(shade.r, 1.2 * shade.b) << "what is missing is the sun's colour";
}

TEST(MarkerShadeCorrection, TakesTheRootOfWhatIsMoreThanAllTheSun) {
  const double all_sun = std::exp(MeanLog(OpenOver(0.0)));
  for (const double more : {1.1, 1.5, 2.0}) {
    ExpectNear(MarkerShadeCorrection(all_sun * more, kSun, kSky), OpenOver(0.0) * std::sqrt(more));
  }
}

TEST(MarkerShadeCorrection, IsNoneWhereTheMarkerIsNoDarkerOrThereIsNoSun) {
  ExpectNear(MarkerShadeCorrection(1.0, kSun, kSky), {1, 1, 1});
  ExpectNear(MarkerShadeCorrection(0.7, kSun, kSky), {1, 1, 1});
  EXPECT_EQ(MarkerShadeCorrection(1.8, {}, kSky), (LinearRgb{1, 1, 1}));
}

}  // namespace
}  // namespace pleinair::compositor
