// Levels of displacements, and of nearest nodes as Aristizabal et al. 2012 published them.
#include "content/flow/flow_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "content/flow/nearest_levels.h"
#include "tests/content/flow/made_fields.h"

namespace pleinair::content {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr int kSteps = 128, kLevels = 7;
constexpr double kRadius = 0.4;  // Of half the width: two cores of the vortex.

Vec3 Around(int degrees) {
  const double angle = degrees * kTurn / 360.0;
  return {kRadius * std::cos(angle), kRadius * std::sin(angle), 0.0};
}

/// RMS over a circle, in cells, of the way to the start after one revolution in 128 steps.
template <typename Levels>
double ClosingError(const Levels& levels, double cell_m) {
  double sum = 0.0;
  for (int degrees = 0; degrees < 360; ++degrees) {
    const Vec3 off = levels.After(Around(degrees), kSteps) - Around(degrees);
    sum += Dot(off, off);
  }
  return std::sqrt(sum / 360.0) / cell_m;
}

// Published figures: 22.8, 17.7 and 13.6 cells.
TEST(NearestLevels, HaveTheErrorOfTheirRounding) {
  for (const auto& [count, published] : {std::pair{65, 22.8}, {129, 17.7}, {257, 13.6}}) {
    const auto field = MakeSteady(Square(count, 1.0), SolidRotation);
    const auto levels = NearestLevels::Build(*field, 0.0, kTurn / kSteps, kLevels);
    ASSERT_TRUE(levels);
    EXPECT_NEAR(ClosingError(*levels, field->cell_m()) / published, 1.0, 0.2) << count;
  }
  const auto vortex = MakeSteady(Square(129, 1.0), Rankine);
  const auto levels = NearestLevels::Build(*vortex, 0.0, 4.0 * kTurn / kSteps, kLevels);
  EXPECT_NEAR(ClosingError(*levels, vortex->cell_m()) / 18.8, 1.0, 0.2);
}

TEST(NearestLevels, RunAlongTheGridForEver) {
  // A uniform flow at 20 degrees, by steps of one cell: each rounds to the same neighbour.
  const double angle = 20.0 * kTurn / 360.0;
  const auto field = MakeSteady(Square(101, 50.0), [&](const Vec3&) {
    return Vec3{std::cos(angle), std::sin(angle), 0.0};
  });
  const auto levels = NearestLevels::Build(*field, 0.0, 1.0, 5);
  const Vec3 after = levels->After({-40.0, 0.0, 0.0}, 32);
  EXPECT_EQ(after.x, -8.0);
  EXPECT_EQ(after.y, 0.0);
  // Less than half a cell stands still.
  const auto slow = NearestLevels::Build(*field, 0.0, 0.4, 5);
  EXPECT_EQ(slow->After({-40.0, 0.0, 0.0}, 32).x, -40.0);
  EXPECT_TRUE(std::isnan(levels->After({45.0, 0.0, 0.0}, 32).x));
}

TEST(FlowLevels, KeepToFineStepsWithinATenthOfACell) {
  for (const Interpolation interpolation : {Interpolation::kLinear, Interpolation::kCubic}) {
    const auto rotation = MakeSteady(Square(129, 1.0), SolidRotation, interpolation);
    const auto turned = FlowLevels::Build(*rotation, 0.0, kTurn / kSteps, kLevels);
    ASSERT_TRUE(turned);
    EXPECT_LE(ClosingError(*turned, rotation->cell_m()), 1e-3);
    const auto vortex = MakeSteady(Square(129, 1.0), Rankine, interpolation);
    const double period = 4.0 * kTurn;  // At two cores.
    const auto levels = FlowLevels::Build(*vortex, 0.0, period / kSteps, kLevels);
    double sum = 0.0;
    for (int degrees = 0; degrees < 360; degrees += 10) {
      const Vec3 off = levels->After(Around(degrees), kSteps) -
                       FineRk4(*vortex, Around(degrees), 0.0, period, 2000);
      sum += Dot(off, off);
    }
    EXPECT_LE(std::sqrt(sum / 36.0) / vortex->cell_m(), 0.1);
  }
}

TEST(FlowLevels, TakeAnyNumberOfSteps) {
  const auto field = MakeSteady(Square(65, 1.0), SolidRotation);
  const auto levels = FlowLevels::Build(*field, 0.0, kTurn / kSteps, kLevels);
  const Vec3 start = Around(30);
  EXPECT_EQ(levels->After(start, 0), start);
  for (const std::uint32_t steps : {1U, 5U, 32U, 77U, 255U}) {
    const double angle = kTurn * (30.0 / 360.0 + steps / 128.0);
    const Vec3 exact{kRadius * std::cos(angle), kRadius * std::sin(angle), 0.0};
    EXPECT_LE(Norm(levels->After(start, steps) - exact), 1e-5) << steps;
  }
}

TEST(FlowLevels, IntegrateDirectlyNearTheBorder) {
  // A particle near the side of a uniform flow that leaves at the end.
  const auto field = MakeSteady(Square(65, 1.0), [](const Vec3&) { return Vec3{1.0, 0.0, 0.0}; });
  const auto levels = FlowLevels::Build(*field, 0.0, 0.01, 6);
  const Vec3 after = levels->After({0.3, 0.999, 0.0}, 64);
  EXPECT_NEAR(after.x, 0.94, 1e-6);
  EXPECT_NEAR(after.y, 0.999, 1e-9);
  EXPECT_TRUE(std::isnan(levels->After({0.4, 0.0, 0.0}, 64).x));
  EXPECT_NEAR(levels->After({0.4, 0.0, 0.0}, 59).x, 0.99, 1e-6);
}

TEST(FlowLevels, WorkInThreeDimensionsAndOnClosedAxes) {
  const double cell = kTurn / 64.0;
  const GridAxis axis = GridAxis::Closed(0.0, cell, 64);
  const auto field = MakeSteady({{axis, axis, axis}, {}}, AbcFlow, Interpolation::kCubic);
  const auto levels = FlowLevels::Build(*field, 0.0, 0.01, 5);
  for (int i = 0; i < 10; ++i) {
    const Vec3 start{0.1 + 0.6 * i, 6.0 - 0.5 * i, 0.3 * i};
    EXPECT_LE(Norm(levels->After(start, 32) - FineRk4(*field, start, 0.0, 0.32, 200)) / cell, 1e-3)
        << i;
  }
}

TEST(FlowLevels, AreTheSameForAnyNumberOfThreads) {
  const auto field = MakeSteady(Square(129, 1.0), Rankine);
  const auto one = FlowLevels::Build(*field, 0.0, 0.1, 5, 1);
  const auto two = FlowLevels::Build(*field, 0.0, 0.1, 5, 2);
  for (int degrees = 0; degrees < 360; degrees += 30) {
    EXPECT_EQ(one->After(Around(degrees), 63), two->After(Around(degrees), 63));
  }
  EXPECT_EQ(one->field_reads(), two->field_reads());
}

TEST(FlowLevels, RefuseMoreThanMemoryHolds) {
  const auto field = MakeSteady(Square(65, 1.0), SolidRotation);
  EXPECT_FALSE(FlowLevels::Build(*field, 0.0, 0.1, 31));
  EXPECT_FALSE(NearestLevels::Build(*field, 0.0, 0.1, 31));
}

}  // namespace
}  // namespace pleinair::content
