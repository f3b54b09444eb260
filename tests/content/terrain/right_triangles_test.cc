#include "content/terrain/right_triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace pleinair::content {
namespace {

Image<float> Hills(int width, int height) {
  Image<float> heights(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      heights(x, y) = static_cast<float>(8.0 * std::sin(0.07 * x) * std::cos(0.05 * y) + 0.02 * x);
    }
  }
  return heights;
}

std::vector<GridTriangle> Triangles(const Image<float>& heights, float max_error,
                                    float* bound = nullptr) {
  std::vector<GridTriangle> triangles;
  const float largest = RightTriangles(heights).Emit(
      max_error, [&](const GridTriangle& triangle) { triangles.push_back(triangle); });
  if (bound != nullptr) *bound = largest;
  return triangles;
}

double TwiceArea(const GridTriangle& t) {
  return 1.0 * (t[1].x - t[0].x) * (t[2].y - t[0].y) - 1.0 * (t[1].y - t[0].y) * (t[2].x - t[0].x);
}

/// Largest difference of the bilinear surface from the triangles, at eighths of cells.
double LargestError(const Image<float>& heights, const std::vector<GridTriangle>& triangles) {
  double largest = 0.0;
  constexpr int kParts = 8;
  for (const GridTriangle& t : triangles) {
    const int x0 = std::min({t[0].x, t[1].x, t[2].x}), x1 = std::max({t[0].x, t[1].x, t[2].x});
    const int y0 = std::min({t[0].y, t[1].y, t[2].y}), y1 = std::max({t[0].y, t[1].y, t[2].y});
    for (int v = y0 * kParts; v <= y1 * kParts; ++v) {
      for (int u = x0 * kParts; u <= x1 * kParts; ++u) {
        const double x = 1.0 * u / kParts, y = 1.0 * v / kParts;
        double part[3];
        for (int i = 0; i < 3; ++i) {
          const GridCorner &a = t[static_cast<std::size_t>((i + 1) % 3)],
                           &b = t[static_cast<std::size_t>((i + 2) % 3)];
          part[i] = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / TwiceArea(t);
        }
        if (std::min({part[0], part[1], part[2]}) < -1e-9) continue;
        double plane = 0.0;
        for (std::size_t i = 0; i < 3; ++i) plane += part[i] * heights(t[i].x, t[i].y);
        const int column = std::min(u / kParts, heights.width() - 2);
        const int row = std::min(v / kParts, heights.height() - 2);
        const double p = x - column, q = y - row;
        const double surface =
            (heights(column, row) * (1 - p) + heights(column + 1, row) * p) * (1 - q) +
            (heights(column, row + 1) * (1 - p) + heights(column + 1, row + 1) * p) * q;
        largest = std::max(largest, std::fabs(surface - plane));
      }
    }
  }
  return largest;
}

double Area(const std::vector<GridTriangle>& triangles) {
  double area = 0.0;
  for (const GridTriangle& t : triangles) {
    EXPECT_GT(TwiceArea(t), 0.0);
    area += 0.5 * TwiceArea(t);
  }
  return area;
}

TEST(RightTriangles, CoverTheGridWithinTheError) {
  for (const auto& [width, height] : {std::pair{65, 65}, {64, 40}, {33, 100}, {2, 2}, {3, 2}}) {
    const Image<float> heights = Hills(width, height);
    for (const float max_error : {0.02F, 0.2F, 2.0F}) {
      float bound = 0.0F;
      const std::vector<GridTriangle> triangles = Triangles(heights, max_error, &bound);
      EXPECT_NEAR(Area(triangles), (width - 1.0) * (height - 1.0), 1e-9);
      EXPECT_LE(LargestError(heights, triangles), max_error + 1e-4) << width << ", " << max_error;
      EXPECT_LE(bound, max_error);
    }
  }
}

// A side of a triangle is that of one neighbour, or lies on the border: no corner of another lies
// within it.
TEST(RightTriangles, HaveNoCracks) {
  const Image<float> heights = Hills(65, 50);
  const std::vector<GridTriangle> triangles = Triangles(heights, 0.3F);
  std::map<std::pair<std::pair<int, int>, std::pair<int, int>>, int> sides;
  for (const GridTriangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const GridCorner &a = t[i], &b = t[(i + 1) % 3];
      ++sides[{{a.x, a.y}, {b.x, b.y}}];
    }
  }
  for (const auto& [side, count] : sides) {
    EXPECT_EQ(count, 1);
    const auto& [a, b] = side;
    const bool is_border = (a.first == b.first && (a.first == 0 || a.first == 64)) ||
                           (a.second == b.second && (a.second == 0 || a.second == 49));
    EXPECT_EQ(sides.contains({b, a}), !is_border);
  }
}

TEST(RightTriangles, NeedTwoForAPlaneAndFewForFlatParts) {
  Image<float> plane(65, 65);
  for (int y = 0; y < 65; ++y) {
    for (int x = 0; x < 65; ++x) plane(x, y) = 0.5F * static_cast<float>(x - 2 * y);
  }
  EXPECT_EQ(Triangles(plane, 0.001F).size(), 2U);
  plane(20, 31) += 5.0F;
  const std::size_t with_peak = Triangles(plane, 0.001F).size();
  EXPECT_GT(with_peak, 8U);
  EXPECT_LT(with_peak, 200U);
}

TEST(RightTriangles, LeaveOutCellsWithoutData) {
  Image<float> heights = Hills(33, 33);
  std::mt19937 random(7);
  std::uniform_int_distribution<int> place(0, 32);
  std::set<std::pair<int, int>> missing;
  for (int i = 0; i < 20; ++i) missing.insert({place(random), place(random)});
  for (const auto& [x, y] : missing) heights(x, y) = std::numeric_limits<float>::quiet_NaN();
  int whole = 0;
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      whole +=
          std::isnan(heights(x, y) + heights(x + 1, y) + heights(x, y + 1) + heights(x + 1, y + 1))
              ? 0
              : 1;
    }
  }
  const std::vector<GridTriangle> triangles = Triangles(heights, 0.1F);
  EXPECT_NEAR(Area(triangles), whole, 1e-9);
  for (const GridTriangle& t : triangles) {
    for (const GridCorner& corner : t) EXPECT_FALSE(missing.contains({corner.x, corner.y}));
  }
}

// A twisted cell differs from both of its halves by a quarter of the twist.
TEST(RightTriangles, StateTheErrorThatRemains) {
  Image<float> heights(2, 2);
  heights(1, 1) = 1.0F;
  float bound = 0.0F;
  const std::vector<GridTriangle> triangles = Triangles(heights, 0.01F, &bound);
  EXPECT_EQ(triangles.size(), 2U);
  EXPECT_FLOAT_EQ(bound, 0.25F);
  EXPECT_NEAR(LargestError(heights, triangles), 0.25, 1e-6);
}

}  // namespace
}  // namespace pleinair::content
