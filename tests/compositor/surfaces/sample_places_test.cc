// Places in a pixel, against exact areas.
#include "compositor/surfaces/sample_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

namespace pleinair::compositor {
namespace {

/// Area of the unit square around the origin where n·x < d: the integral of two boxes' convolution.
double AreaBelow(glm::dvec2 n, double d) {
  const double a = std::max(std::abs(n.x), std::abs(n.y));
  const double b = std::max(std::min(std::abs(n.x), std::abs(n.y)), 1e-9);
  const auto ramp = [](double x) { return x > 0.0 ? 0.5 * x * x : 0.0; };
  return (ramp(d + (a + b) / 2) - ramp(d + (a - b) / 2) - ramp(d - (a - b) / 2) +
          ramp(d - (a + b) / 2)) /
         (a * b);
}

struct CoverageErrors {
  double rms = 0.0, worst = 0.0;
};

/// Errors of the share of `places` below random straight edges whose angle to an axis is at most
/// `max_angle`.
CoverageErrors ErrorsOf(const std::vector<glm::vec2>& places, double max_angle) {
  std::mt19937 random(5);
  const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
  CoverageErrors errors;
  constexpr int kEdges = 2000;
  for (int i = 0; i < kEdges; ++i) {
    const double angle =
        std::floor(4 * uniform()) * std::numbers::pi / 2 + (2 * uniform() - 1) * max_angle;
    const glm::dvec2 n(std::cos(angle), std::sin(angle));
    const double d = (uniform() - 0.5) * (std::abs(n.x) + std::abs(n.y));
    const auto below = std::count_if(places.begin(), places.end(),
                                     [&](glm::vec2 p) { return glm::dot(n, glm::dvec2(p)) < d; });
    const double error =
        static_cast<double>(below) / static_cast<double>(places.size()) - AreaBelow(n, d);
    errors.rms += error * error / kEdges;
    errors.worst = std::max(errors.worst, std::abs(error));
  }
  errors.rms = std::sqrt(errors.rms);
  return errors;
}

constexpr double kAnyAngle = std::numbers::pi / 4;
constexpr double kNearAxis = 3 * std::numbers::pi / 180;

TEST(SamplePlaces, OfSixtyFourCoverStraightEdgesWellAtAnyAngle) {
  const CoverageErrors any = ErrorsOf(SamplePlaces(64), kAnyAngle);
  EXPECT_LE(any.rms, 0.014);
  EXPECT_LE(any.worst, 0.075);
  EXPECT_LE(ErrorsOf(SamplePlaces(64), kNearAxis).rms, 0.012);
}

TEST(SamplePlaces, OfFourAreTheRotatedGrid) {
  const CoverageErrors four = ErrorsOf(SamplePlaces(4), kAnyAngle);
  EXPECT_NEAR(four.rms, 0.093, 0.005);
  EXPECT_NEAR(four.worst, 0.30, 0.03);
  EXPECT_NEAR(ErrorsOf({{0, 0}}, kAnyAngle).rms, 0.253, 0.02) << "the center alone";
}

TEST(SamplePlaces, AreWithinThePixelAroundItsCenter) {
  double before = 1.0;
  for (const int count : {4, 8, 16, 32, 64}) {
    const std::vector<glm::vec2> places = SamplePlaces(count);
    ASSERT_EQ(places.size(), static_cast<std::size_t>(count));
    std::set<std::pair<float, float>> distinct;
    glm::dvec2 mean(0.0);
    for (const glm::vec2 p : places) {
      EXPECT_LT(std::max(std::abs(p.x), std::abs(p.y)), 0.5F);
      distinct.insert({p.x, p.y});
      mean += glm::dvec2(p) / static_cast<double>(count);
    }
    EXPECT_EQ(distinct.size(), places.size());
    EXPECT_LT(std::max(std::abs(mean.x), std::abs(mean.y)), 1e-6) << count;
    const double rms = ErrorsOf(places, kAnyAngle).rms;
    EXPECT_LT(rms, before) << count;
    before = rms;
  }
}

}  // namespace
}  // namespace pleinair::compositor
