#include "tracker/refinement/marker_coverage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tracker/april_tag_detector.h"

namespace pleinair::tracker {
namespace {

// Two halves, black at the left: the coverage across one straight edge has a closed form.
MarkerPattern Halves() { return {.modules = 2, .edge_modules = 2, .white = {0, 1, 0, 1}}; }

TEST(MarkerCoverage, OfAPixelOnAStraightEdgeIsTheShareOfItsArea) {
  const MarkerPattern pattern = Halves();
  constexpr double kPerPixel = 0.02;  // Half edges: the marker is 100 px wide.
  for (const double offset_px : {-0.4, -0.2, 0.0, 0.1, 0.3}) {
    const Coverage coverage = CoverageOfPixel(pattern, {offset_px * kPerPixel, 0.1}, {kPerPixel, 0},
                                              {0, -kPerPixel}, 0.05);
    EXPECT_NEAR(coverage.white, 0.5 + offset_px, 0.05) << offset_px;
  }
}

TEST(MarkerCoverage, OfABlurredEdgeIsTheGaussianIntegral) {
  const MarkerPattern pattern = Halves();
  constexpr double kPerPixel = 0.02, kBlur_px = 1.5;
  for (double offset_px = -4.0; offset_px <= 4.0; offset_px += 0.5) {
    // Mean of Φ over the pixel's width, by the midpoint rule.
    double expected = 0.0;
    for (int i = 0; i < 1000; ++i) {
      const double at = offset_px + (i + 0.5) / 1000 - 0.5;
      expected += 0.5 * std::erfc(-at / (kBlur_px * std::sqrt(2.0))) / 1000;
    }
    const Coverage coverage = CoverageOfPixel(pattern, {offset_px * kPerPixel, 0.1}, {kPerPixel, 0},
                                              {0, -kPerPixel}, kBlur_px);
    EXPECT_NEAR(coverage.white, expected, 2e-3) << offset_px;
  }
}

TEST(MarkerCoverage, DerivativesAreThoseOfFiniteDifferences) {
  const auto pattern = AprilTagPattern("tag36h11", 11);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-1.2, 1.2), step(-0.04, 0.04), blur(0.2, 1.5);
  for (int i = 0; i < 300; ++i) {
    const Vec2 centre{place(random), place(random)};
    const Vec2 d_x{step(random), step(random)}, d_y{step(random), step(random)};
    const double blur_px = blur(random);
    const auto white = [&](double du, double dv, double d_log_blur) {
      return CoverageOfPixel(*pattern, centre + Vec2{du, dv}, d_x, d_y,
                             blur_px * std::exp(d_log_blur))
          .white;
    };
    const Coverage coverage = CoverageOfPixel(*pattern, centre, d_x, d_y, blur_px);
    constexpr double kStep = 1e-6;
    // Where a column comes into reach the sum jumps by Φ(-3.2) = 7e-4, observed as a slope of 700.
    const double by_u = (white(kStep, 0, 0) - white(-kStep, 0, 0)) / (2 * kStep);
    const double by_v = (white(0, kStep, 0) - white(0, -kStep, 0)) / (2 * kStep);
    const double by_blur = (white(0, 0, kStep) - white(0, 0, -kStep)) / (2 * kStep);
    if (std::fabs(by_u) < 200) {
      EXPECT_NEAR(coverage.d_u, by_u, 1e-4);
    }
    if (std::fabs(by_v) < 200) {
      EXPECT_NEAR(coverage.d_v, by_v, 1e-4);
    }
    if (std::fabs(by_blur) < 50) {
      EXPECT_NEAR(coverage.d_log_blur, by_blur, 1e-4);
    }
  }
}

}  // namespace
}  // namespace pleinair::tracker
