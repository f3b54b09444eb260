// Lines at even distances: the published properties, on fields with vortices, saddles and walls.
#include "content/flow/even_placement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "tests/content/flow/made_fields.h"

namespace pleinair::content {
namespace {

struct Case {
  std::string name;
  std::shared_ptr<const GridField> field;
  double spacing_m;
};
void PrintTo(const Case& each, std::ostream* out) { *out << each.name; }

std::vector<Case> Cases() {
  const auto gyre = [](const Vec3& p) {
    constexpr double kPi = std::numbers::pi;
    return Vec3{-std::sin(kPi * p.x) * std::cos(kPi * p.y),
                std::cos(kPi * p.x) * std::sin(kPi * p.y), 0.0};
  };
  const auto cylinder = [](const Vec3& p) {
    // Potential flow around a cylinder of radius 0.3.
    const double r2 = p.x * p.x + p.y * p.y, a2 = 0.09;
    if (r2 < a2) {
      const double nan = std::numeric_limits<double>::quiet_NaN();
      return Vec3{nan, nan, 0.0};
    }
    return Vec3{1.0 - a2 * (p.x * p.x - p.y * p.y) / (r2 * r2), -2.0 * a2 * p.x * p.y / (r2 * r2),
                0.0};
  };
  return {{"uniform",
           MakeSteady(Square(65, 1.0),
                      [](const Vec3&) {
                        return Vec3{1, 0.3, 0};
                      }),
           0.1},
          {"vortex", MakeSteady(Square(129, 1.0), Rankine), 0.07},
          {"saddle",
           MakeSteady(Square(65, 1.0),
                      [](const Vec3& p) {
                        return Vec3{p.x, -p.y, 0};
                      }),
           0.05},
          {"gyres", MakeSteady(Square(129, 1.0), gyre), 0.06},
          {"cylinder", MakeSteady(Square(129, 1.0), cylinder), 0.05},
          // Lines nearer to each other than the cells.
          {"dense", MakeSteady(Square(17, 1.0), gyre), 0.05}};
}

class EvenPlacement : public ::testing::TestWithParam<Case> {};

double LengthOfLine(const FlowLine& line) {
  double length = 0.0;
  for (std::size_t i = 1; i < line.points.size(); ++i) {
    length += Norm(line.points[i] - line.points[i - 1]);
  }
  return length;
}

TEST_P(EvenPlacement, KeepsItsDistancesAndCoversTheFlow) {
  const auto& [name, field, spacing_m] = GetParam();
  const auto lines = PlaceLines(*field, spacing_m, {});
  ASSERT_TRUE(lines);
  ASSERT_GT(lines->size(), 10U);
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < lines->size(); ++a) {
    const FlowLine& line = (*lines)[a];
    EXPECT_EQ(line.points.size(), line.times_s.size());
    const bool closed =
        line.upstream_end == LineEnd::kClosed || line.downstream_end == LineEnd::kClosed;
    EXPECT_TRUE(closed || LengthOfLine(line) >= 0.99 * spacing_m);
    for (std::size_t b = 0; b < a; ++b) {
      for (const Vec3& p : line.points) {
        for (const Vec3& q : (*lines)[b].points) nearest = std::min(nearest, Norm(p - q));
      }
    }
  }
  EXPECT_GE(nearest, 0.98 * 0.5 * spacing_m);
  const LineSpacing measured = MeasureSpacing(*field, 0.0, *lines, spacing_m);
  EXPECT_NEAR(measured.nearest_min_m, nearest, 1e-12);
  EXPECT_GE(measured.covered, 0.98);
}

TEST_P(EvenPlacement, IsTheSameForAnyNumberOfThreads) {
  const auto& [name, field, spacing_m] = GetParam();
  const auto one = PlaceLines(*field, spacing_m, {.threads = 1});
  const auto two = PlaceLines(*field, spacing_m, {.threads = 2});
  ASSERT_EQ(one->size(), two->size());
  for (std::size_t i = 0; i < one->size(); ++i) EXPECT_EQ((*one)[i].points, (*two)[i].points);
}

INSTANTIATE_TEST_SUITE_P(Fields, EvenPlacement, ::testing::ValuesIn(Cases()),
                         [](const auto& each) { return each.param.name; });

TEST(EvenPlacement, FillsASpace) {
  const GridAxis axis(-1.0, 0.1, 21);
  const auto field = MakeSteady({{axis, axis, axis}, {}}, [](const Vec3& p) {
    return Vec3{-p.y, p.x, 0.3};
  });
  const auto lines = PlaceLines(*field, 0.3, {});
  ASSERT_TRUE(lines);
  const LineSpacing measured = MeasureSpacing(*field, 0.0, *lines, 0.3);
  EXPECT_GE(measured.nearest_min_m, 0.98 * 0.15);
  EXPECT_GE(measured.covered, 0.98);
}

TEST(EvenPlacement, RefusesSpacingsThatAreNone) {
  const auto field = MakeSteady(Square(9, 1.0), SolidRotation);
  EXPECT_FALSE(PlaceLines(*field, 0.0, {}));
  EXPECT_FALSE(PlaceLines(*field, -1.0, {}));
  EXPECT_FALSE(PlaceLines(*field, 1e-7, {}));
}

TEST(EvenPlacement, HasNoLinesWithoutFlow) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto walls = MakeSteady(Square(9, 1.0), [&](const Vec3&) { return Vec3{nan, nan, nan}; });
  EXPECT_TRUE(PlaceLines(*walls, 0.2, {})->empty());
  const auto calm = MakeSteady(Square(9, 1.0), [](const Vec3&) { return Vec3{}; });
  EXPECT_TRUE(PlaceLines(*calm, 0.2, {})->empty());
}

}  // namespace
}  // namespace pleinair::content
