#include "compositor/lens/stop_places.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace pleinair::compositor {
namespace {

TEST(StopPlaces, HaveTheMomentsOfADisc) {
  for (const int count : {64, 256, 1024}) {
    const std::vector<Vec2> places = StopPlaces({}, count);
    ASSERT_EQ(places.size(), static_cast<std::size_t>(count));
    Vec2 mean{0, 0};
    double xx = 0, yy = 0;
    for (const Vec2 p : places) {
      mean = mean + p * (1.0 / count);
      xx += p.x * p.x / count;
      yy += p.y * p.y / count;
      EXPECT_LT(Norm(p), 1.05);
    }
    EXPECT_LT(Norm(mean), 1e-12);
    EXPECT_NEAR(xx, 0.25, 1.0 / count);
    EXPECT_NEAR(yy, 0.25, 1.0 / count);
  }
}

TEST(StopPlaces, OfOneIsTheCentre) {
  const std::vector<Vec2> places = StopPlaces({5, 0.3}, 1);
  ASSERT_EQ(places.size(), 1U);
  EXPECT_LT(Norm(places[0]), 1e-12);
}

TEST(StopPlaces, FillTheAreaOfAPolygon) {
  // Share of the places within half of the inscribed circle: its area over that of the polygon.
  for (const int blades : {3, 6, 16}) {
    const double rotation = 0.2, side = std::numbers::pi / blades, inner = std::cos(side);
    const std::vector<Vec2> places = StopPlaces({blades, rotation}, 4096);
    int inside = 0;
    for (const Vec2 p : places) {
      if (Norm(p) < 0.5 * inner) ++inside;
      for (int i = 0; i < blades; ++i) {
        const double normal = rotation + (2 * i + 1) * side;
        EXPECT_LT(p.x * std::cos(normal) + p.y * std::sin(normal), inner + 0.01);
      }
    }
    const double area = 0.5 * blades * std::sin(2 * side);
    EXPECT_NEAR(inside / 4096.0, std::numbers::pi * 0.25 * inner * inner / area, 0.01);
  }
}

}  // namespace
}  // namespace pleinair::compositor
