// Interpolation on structured grids.
#include "content/flow/grid_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "content/flow/grid_stencil.h"
#include "tests/content/flow/made_fields.h"

namespace pleinair::content {
namespace {

std::vector<double> UnequalNodes() {
  std::vector<double> nodes;
  for (int i = 0; i < 12; ++i) nodes.push_back(0.1 * i + 0.013 * i * i);
  return nodes;
}

TEST(GridAxis, FindsPlacesOfUniformAndUnequalNodes) {
  const GridAxis uniform(2.0, 0.5, 11);
  EXPECT_EQ(uniform.Find(3.25, 0).index, 2);
  EXPECT_DOUBLE_EQ(uniform.Find(3.25, 0).fraction, 0.5);
  EXPECT_EQ(uniform.Find(7.0, 0).index, 9);
  EXPECT_DOUBLE_EQ(uniform.Find(7.0, 0).fraction, 1.0);
  EXPECT_DOUBLE_EQ(uniform.Find(1.75, 0).fraction, -0.5);
  EXPECT_TRUE(uniform.Contains(7.0));
  EXPECT_FALSE(uniform.Contains(7.001));
  const GridAxis unequal(UnequalNodes());
  EXPECT_FALSE(unequal.uniform());
  for (int i = 0; i + 1 < unequal.count(); ++i) {
    for (const int hint : {0, 5, 10}) {
      const auto found = unequal.Find(0.25 * unequal.Node(i) + 0.75 * unequal.Node(i + 1), hint);
      EXPECT_EQ(found.index, i);
      EXPECT_NEAR(found.fraction, 0.75, 1e-12);
    }
  }
}

TEST(GridAxis, TakesRoundedCoordinatesForUniform) {
  std::vector<double> nodes;
  for (int i = 0; i < 200; ++i) nodes.push_back(static_cast<float>(350.0 + 0.1 * i));
  EXPECT_TRUE(GridAxis(nodes).uniform());
}

TEST(GridAxis, WrapsLongitudes) {
  const GridAxis axis = GridAxis::Closed(0.0, 10.0, 36);
  EXPECT_EQ(axis.count(), 39);
  for (const double turn : {-360.0, 0.0, 720.0}) {
    const auto found = axis.Find(355.0 + turn, 0);
    EXPECT_EQ(found.index, GridAxis::kNodesBefore + 35);
    EXPECT_NEAR(found.fraction, 0.5, 1e-9);
  }
}

// Each kind of interpolation continues its polynomials exactly, at the border and beyond it.
TEST(GridField, InterpolatesPolynomialsExactly) {
  const GridAxis uniform(-1.0, 0.25, 9);
  const auto linear = [](const Vec3& p) {
    return Vec3{1.0 + p.x - p.y + 0.5 * p.x * p.y * p.z, p.z, 2.0 - p.x};
  };
  const auto quadratic = [](const Vec3& p) {
    return Vec3{p.x * p.x - p.y * p.z + 1.0, p.y * p.y * p.x, p.z * p.z - p.x};
  };
  for (const GridAxis& axis : {uniform, GridAxis(UnequalNodes())}) {
    const StructuredGrid grid{{axis, axis, axis}, {}};
    const auto bilinear = MakeSteady(grid, linear);
    const auto cubic = MakeSteady(grid, quadratic, Interpolation::kCubic);
    const double first = axis.first_m(), size = axis.last_m() - axis.first_m();
    for (int i = 0; i <= 10; ++i) {
      const Vec3 p{first + 0.1 * i * size, first + (1.0 - 0.09 * i) * size,
                   first + 0.057 * i * size};
      EXPECT_LE(Norm(bilinear->At(p, 0.0) - linear(p)), 1e-12) << i;
      EXPECT_LE(Norm(cubic->At(p, 0.0) - quadratic(p)), 1e-12) << i;
    }
  }
}

TEST(GridField, IsFourthOrderInsideWithCubicInterpolation) {
  const auto wave = [](const Vec3& p) { return Vec3{std::sin(3.0 * p.x), std::cos(3.0 * p.y), 0}; };
  std::vector<double> errors;
  for (const int count : {33, 65}) {
    const auto field = MakeSteady(Square(count, 1.0), wave, Interpolation::kCubic);
    double worst = 0.0;
    for (int i = 0; i < 300; ++i) {
      const Vec3 p{-0.5 + 0.0033 * i, 0.5 - 0.0021 * i, 0.0};
      worst = std::max(worst, Norm(field->At(p, 0.0) - wave(p)));
    }
    errors.push_back(worst);
  }
  // Catmull and Rom's splines are of third order between nodes.
  EXPECT_GT(errors[0] / errors[1], 6.0);
}

TEST(GridField, IsLinearInTimeAndHoldsItsEnds) {
  const auto field = MakeField(
      Square(5, 1.0), {0.0, 10.0, 40.0},
      [](const Vec3&, Seconds t) {
        return Vec3{t * t, 0.0, 0.0};
      },
      Interpolation::kLinear);
  EXPECT_NEAR(field->At({0.0, 0.0, 0.0}, 5.0).x, 50.0, 1e-12);
  EXPECT_NEAR(field->At({0.0, 0.0, 0.0}, 25.0).x, 850.0, 1e-12);
  EXPECT_NEAR(field->At({0.0, 0.0, 0.0}, -3.0).x, 0.0, 1e-12);
  EXPECT_NEAR(field->At({0.0, 0.0, 0.0}, 90.0).x, 1600.0, 1e-12);
  EXPECT_NEAR(field->At({0.0, 0.0, 0.0}, 10.0).x, 100.0, 1e-12);
}

TEST(GridField, HasNoVelocityOutsideAndInWalls) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Interpolation interpolation : {Interpolation::kLinear, Interpolation::kCubic}) {
    const auto field = MakeSteady(
        Square(9, 1.0),
        [&](const Vec3& p) {
          return Vec3{1.0, p.x > 0.6 ? nan : 1.0, 0.0};
        },
        interpolation);
    EXPECT_TRUE(std::isnan(field->At({-1.1, 0.0, 0.0}, 0.0).x));
    EXPECT_TRUE(std::isnan(field->At({0.6, 0.0, 0.0}, 0.0).x));
    EXPECT_EQ(field->At({0.49, 0.0, 0.0}, 0.0).x, 1.0);
    EXPECT_EQ(field->At({0.5, 1.0, 0.0}, 0.0).x, 1.0);
  }
}

TEST(GridField, ReadsEachTimeOnceInOrderAndKeepsTwo) {
  std::vector<std::size_t> reads;
  const auto read = [&](std::size_t time) -> Result<FieldSlice> {
    reads.push_back(time);
    FieldSlice slice;
    slice.singles.assign(2 * 25, static_cast<float>(time));
    return slice;
  };
  FieldSlices slices(read, 1);
  for (const std::size_t time : {0U, 1U, 0U, 1U, 2U, 1U, 3U, 1U}) {
    EXPECT_EQ((*slices.At(time))->singles[0], static_cast<float>(time));
  }
  EXPECT_THAT(reads, ::testing::ElementsAre(0U, 1U, 2U, 3U));
}

TEST(GridField, RefusesTimesThatDoNotAscend) {
  const auto read = [](std::size_t) -> Result<FieldSlice> { return FieldSlice{}; };
  EXPECT_FALSE(GridField::Create(Square(5, 1.0), {0.0, 2.0, 2.0}, read));
  EXPECT_FALSE(GridField::Create({}, {}, read));
}

TEST(CurvilinearCells, FindEachPointOfATwistedBlock) {
  const auto place = [](double a, double b, double c) {
    return Vec3{a + 0.2 * std::sin(b + c), b + 0.1 * a * c, c + 0.1 * std::cos(2.0 * a)};
  };
  constexpr int kCount = 9;
  std::vector<Vec3> positions;
  for (int n = 0; n < kCount * kCount * kCount; ++n) {
    positions.push_back(
        place(n % kCount * 0.25, n / kCount % kCount * 0.25, n / kCount / kCount * 0.25));
  }
  const auto cells = CurvilinearCells::Create({kCount, kCount, kCount}, positions);
  ASSERT_TRUE(cells);
  GridPlace found;
  for (int n = 0; n < 500; ++n) {
    const Vec3 p = place(0.004 * n, std::fmod(0.37 * n, 2.0), std::fmod(0.73 * n, 2.0));
    // Near the curved surface a point may be outside the flat sides of the cells.
    if (n % 7 == 0) found = {};
    if (!cells->Find(p, &found)) continue;
    Vec3 back{};
    for (int corner = 0; corner < 8; ++corner) {
      double weight = 1.0;
      for (std::size_t a = 0; a < 3; ++a) {
        weight *= corner >> a & 1 ? found.fraction[a] : 1.0 - found.fraction[a];
      }
      back =
          back + cells->Position(found.index[0] + (corner & 1), found.index[1] + (corner >> 1 & 1),
                                 found.index[2] + (corner >> 2)) *
                     weight;
    }
    EXPECT_LE(Norm(back - p), 1e-9) << n;
  }
  found = {};
  EXPECT_TRUE(cells->Find(place(1.9, 1.9, 1.9), &found));
  EXPECT_FALSE(cells->Find({-3.0, 0.0, 0.0}, &found));
  EXPECT_FALSE(CurvilinearCells::Create({1, 5, 1}, std::vector<Vec3>(5)));
  EXPECT_FALSE(CurvilinearCells::Create({3, 3, 1}, std::vector<Vec3>(9)));
}

}  // namespace
}  // namespace pleinair::content
