// Lines through exact and sampled fields, against closed forms and fine Runge-Kutta steps.
#include "content/flow/line_integrator.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/content/flow/made_fields.h"

namespace pleinair::content {
namespace {

using ::testing::SizeIs;

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<FlowLine> Trace(const VectorField& field, const std::vector<Seed>& seeds,
                            const TraceOptions& options = {}) {
  auto lines = TraceLines(field, seeds, options);
  EXPECT_TRUE(lines) << lines.error().Message();
  return lines.value_or(std::vector<FlowLine>{});
}

FlowLine TraceOne(const VectorField& field, const Vec3& seed, const TraceOptions& options = {}) {
  auto lines = Trace(field, {{seed}}, options);
  EXPECT_THAT(lines, SizeIs(1));
  return lines.empty() ? FlowLine{} : lines.front();
}

/// A field that is given by a formula.
class FormulaField final : public VectorField {
 public:
  FormulaField(FieldFunction function, std::vector<Seconds> times)
      : function_(std::move(function)), times_(std::move(times)) {}
  Velocity At(const Vec3& p, Seconds t) const override { return function_(p, t); }
  Box bounds() const override { return {{-1.0, -1.0, 0.0}, {1.0, 1.0, 0.0}}; }
  double cell_m() const override { return 0.02; }
  std::span<const Seconds> times() const override { return times_; }

 private:
  FieldFunction function_;
  std::vector<Seconds> times_;
};

TEST(LineIntegrator, KeepsTheRadiusOfSolidRotationForTenRevolutions) {
  const auto field = MakeSteady(Square(65, 1.0), SolidRotation);
  // Ten turns: a path has no closing.
  const FlowLine line =
      TraceOne(*field, {0.5, 0.1, 0.0},
               {.kind = LineKind::kPath, .length_m = 100.0, .duration_s = 10.0 * kTurn});
  const double radius = std::hypot(0.5, 0.1);
  for (const Vec3& p : line.points) EXPECT_NEAR(std::hypot(p.x, p.y), radius, 1e-4 * radius);
  EXPECT_EQ(line.downstream_end, LineEnd::kDuration);
  EXPECT_NEAR(line.times_s.back(), 10.0 * kTurn, 1e-12);
  EXPECT_NEAR(line.points.back().x, 0.5, 1e-3);
  EXPECT_NEAR(line.points.back().y, 0.1, 1e-3);
}

TEST(LineIntegrator, KeepsTheInvariantOfASaddleUntilItLeaves) {
  const auto field = MakeSteady(Square(33, 1.0), [](const Vec3& p) {
    return Vec3{p.x, -p.y, 0.0};
  });
  const FlowLine line = TraceOne(*field, {0.013, 0.97, 0.0});
  EXPECT_EQ(line.downstream_end, LineEnd::kLeft);
  for (const Vec3& p : line.points) EXPECT_NEAR(p.x * p.y / (0.013 * 0.97), 1.0, 1e-6);
  EXPECT_NEAR(line.points.back().x, 1.0, 1e-8);
  EXPECT_NEAR(line.times_s.back(), std::log(1.0 / 0.013), 1e-6);
}

TEST(LineIntegrator, GoesStraightInAUniformField) {
  const Vec3 wind{0.6, 0.8, 0.0};
  for (const Interpolation interpolation : {Interpolation::kLinear, Interpolation::kCubic}) {
    const auto field = MakeSteady(
        Square(40, 10.0), [&](const Vec3&) { return wind; }, interpolation);
    const FlowLine line = TraceOne(*field, {-3.3, -4.7, 0.0}, {.direction = LineDirection::kBoth});
    EXPECT_EQ(line.upstream_end, LineEnd::kLeft);
    EXPECT_EQ(line.downstream_end, LineEnd::kLeft);
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const Vec3 exact = Vec3{-3.3, -4.7, 0.0} + wind * line.times_s[i];
      EXPECT_NEAR(Norm(line.points[i] - exact), 0.0, 1e-9);
      EXPECT_NEAR(line.speeds_m_s[i], 1.0, 1e-12);
      EXPECT_TRUE(i == 0 || line.times_s[i - 1] < line.times_s[i]);
    }
    EXPECT_NEAR(line.points.back().y, 10.0, 1e-8);
    EXPECT_NEAR(line.points.front().y, -10.0, 1e-8);
  }
}

// The figures are those of fine Runge-Kutta steps on 129² points, as the specification states them.
TEST(LineIntegrator, ClosesTheCirclesOfASampledVortex) {
  const double cell = 2.0 / 128.0;
  for (const auto& [interpolation, bound] :
       {std::pair{Interpolation::kLinear, 0.02}, std::pair{Interpolation::kCubic, 0.001}}) {
    const auto field = MakeSteady(Square(129, 1.0), Rankine, interpolation);
    for (const double cores : {1.25, 2.0, 3.0}) {
      const double radius = 0.2 * cores;
      const double period = kTurn * cores * cores;
      const TraceOptions options{.kind = LineKind::kPath, .duration_s = period};
      const FlowLine line = TraceOne(*field, {radius, 0.0, 0.0}, options);
      const double error = Norm(line.points.back() - Vec3{radius, 0.0, 0.0}) / cell;
      EXPECT_LE(error, bound) << cores << " cores";
      const Vec3 fine = FineRk4(*field, {radius, 0.0, 0.0}, 0.0, period, 20000);
      EXPECT_LE(Norm(line.points.back() - fine) / cell, 1e-3) << cores << " cores";
    }
  }
}

TEST(LineIntegrator, FollowsAbcFlowAsFineStepsDo) {
  const double cell = kTurn / 64.0;
  const GridAxis axis = GridAxis::Closed(0.0, cell, 64);
  const StructuredGrid grid{{axis, axis, axis}, {}};
  for (const Interpolation interpolation : {Interpolation::kLinear, Interpolation::kCubic}) {
    const auto field = MakeSteady(grid, AbcFlow, interpolation);
    for (int i = 0; i < 64; ++i) {
      const Vec3 seed{0.3 + 0.7 * (i % 8), 0.5 + 0.7 * (i / 8), 1.0 + 0.08 * i};
      const FlowLine line =
          TraceOne(*field, seed, {.kind = LineKind::kPath, .length_m = 100.0, .duration_s = 10.0});
      EXPECT_EQ(line.downstream_end, LineEnd::kDuration);
      EXPECT_LE(Norm(line.points.back() - FineRk4(*field, seed, 0.0, 10.0, 4000)) / cell, 2e-3)
          << i;
    }
  }
}

TEST(LineIntegrator, ClosesALineOnce) {
  const auto field = MakeSteady(Square(65, 1.0), SolidRotation);
  for (const double radius : {0.01, 0.2, 0.7}) {
    const FlowLine line = TraceOne(*field, {radius, 0.0, 0.0}, {.direction = LineDirection::kBoth});
    EXPECT_EQ(line.upstream_end, LineEnd::kClosed);
    EXPECT_FALSE(line.downstream_end);
    EXPECT_NEAR(line.times_s.back() - line.times_s.front(), kTurn, 1e-3 / radius);
    EXPECT_LE(Norm(line.points.front() - line.points.back()), 1e-2 * 2.0 / 64.0);
  }
}

TEST(LineIntegrator, EndsAtLengthAndDuration) {
  const auto field = MakeSteady(Square(65, 1.0), SolidRotation);
  const FlowLine by_length = TraceOne(*field, {0.5, 0.0, 0.0}, {.length_m = 0.5 * 1.25});
  EXPECT_EQ(by_length.downstream_end, LineEnd::kLength);
  EXPECT_NEAR(by_length.points.back().x, 0.5 * std::cos(1.25), 1e-5);
  EXPECT_NEAR(by_length.points.back().y, 0.5 * std::sin(1.25), 1e-5);
  EXPECT_NEAR(by_length.times_s.back(), 1.25, 1e-5);
  const FlowLine by_time = TraceOne(*field, {0.5, 0.0, 0.0}, {.duration_s = 1.25});
  EXPECT_EQ(by_time.downstream_end, LineEnd::kDuration);
  EXPECT_NEAR(by_time.points.back().x, 0.5 * std::cos(1.25), 1e-5);
  // The usual length is four diagonals.
  EXPECT_NEAR(LengthOf(*field, {}), 4.0 * std::hypot(2.0, 2.0), 1e-12);
}

TEST(LineIntegrator, RecordsVerticesAtMultiplesOfAStep) {
  const auto field = MakeSteady(Square(65, 1.0), SolidRotation);
  const FlowLine line = TraceOne(*field, {0.5, 0.0, 0.0}, {.duration_s = 2.0, .step_s = 0.25});
  ASSERT_THAT(line.points, SizeIs(9));
  for (std::size_t i = 0; i < 9; ++i) {
    const double t = 0.25 * static_cast<double>(i);
    EXPECT_NEAR(line.times_s[i], t, 1e-12);
    EXPECT_NEAR(line.points[i].x, 0.5 * std::cos(t), 1e-5);
  }
}

TEST(LineIntegrator, EndsWhereNothingMoves) {
  // A sink: the speed falls as the distance from it.
  const auto field = MakeSteady(Square(65, 1.0), [](const Vec3& p) {
    return Vec3{-p.x, -p.y, 0.0};
  });
  const FlowLine line = TraceOne(*field, {0.5, 0.5, 0.0});
  EXPECT_EQ(line.downstream_end, LineEnd::kStagnated);
  EXPECT_LT(Norm(line.points.back()), 2e-6);
  EXPECT_THAT(Trace(*field, {{{0.0, 0.0, 0.0}}}), SizeIs(0));
}

TEST(LineIntegrator, EndsBeforeAWall) {
  // Flow to the right; nothing is known for x > 0.5.
  const auto field = MakeSteady(Square(65, 1.0), [](const Vec3& p) {
    return Vec3{p.x > 0.5 ? kNaN : 1.0, 0.25, 0.0};
  });
  const FlowLine line = TraceOne(*field, {-0.9, 0.0, 0.0});
  EXPECT_EQ(line.downstream_end, LineEnd::kWall);
  EXPECT_NEAR(line.points.back().x, 0.5, 1e-3 * 2.0 / 64.0);
  EXPECT_LE(line.points.back().x, 0.5);
  EXPECT_THAT(Trace(*field, {{{0.6, 0.0, 0.0}}}), SizeIs(0));
}

TEST(LineIntegrator, FlowsAlongTheNodesBesideAWallFromEitherSide) {
  for (const double side : {1.0, -1.0}) {
    const auto field = MakeSteady(Square(65, 1.0), [side](const Vec3& p) {
      return Vec3{1.0, side * p.y > 0.5 ? kNaN : 0.0, 0.0};
    });
    const FlowLine line = TraceOne(*field, {-0.9, side * 0.5, 0.0});
    EXPECT_EQ(line.downstream_end, LineEnd::kLeft) << side;
  }
}

TEST(LineIntegrator, StartsOnTheBorder) {
  const auto field = MakeSteady(Square(64, 1.0), [](const Vec3&) { return Vec3{1.0, 0.5, 0.0}; });
  for (const Vec3& seed : {Vec3{-1.0, -1.0, 0.0}, Vec3{-1.0, 0.25, 0.0}, Vec3{0.25, -1.0, 0.0}}) {
    EXPECT_GT(TraceOne(*field, seed).points.size(), 10U);
  }
  // Outside there is no line; the others keep their numbers.
  const auto lines = Trace(*field, {{{-1.5, 0.0, 0.0}}, {{0.0, 0.0, 0.0}}});
  ASSERT_THAT(lines, SizeIs(1));
  EXPECT_EQ(lines[0].seed, 1U);
}

TEST(LineIntegrator, SkipsNoCellThatIsThin) {
  // A wall of one node in a rectilinear grid with thin cells around it.
  std::vector<double> nodes;
  for (int i = 0; i <= 20; ++i) nodes.push_back(-1.0 + 0.05 * i);
  for (int i = 1; i <= 10; ++i) nodes.push_back(0.001 * i);
  for (int i = 1; i <= 10; ++i) nodes.push_back(0.01 + 0.099 * i);
  const GridAxis y(-1.0, 0.1, 21);
  const auto field = MakeSteady({{GridAxis(nodes), y, GridAxis()}, {}}, [](const Vec3& p) {
    return Vec3{std::fabs(p.x - 0.005) < 1e-6 ? kNaN : 1.0, 0.0, 0.0};
  });
  const FlowLine line = TraceOne(*field, {-0.99, 0.0, 0.0});
  EXPECT_EQ(line.downstream_end, LineEnd::kWall);
  EXPECT_NEAR(line.points.back().x, 0.004, 1e-5);
}

TEST(LineIntegrator, MovesInAnyPlaneAndAlongALine) {
  const GridAxis axis(-1.0, 0.1, 21);
  const auto turn = [](const Vec3& p) { return Vec3{-p.z, 7.0, p.x}; };
  const auto upright = MakeSteady({{axis, GridAxis(3.0, 1.0, 1), axis}, {}}, turn);
  const FlowLine circle = TraceOne(*upright, {0.5, 3.0, 0.0}, {.duration_s = 1.0});
  EXPECT_NEAR(circle.points.back().x, 0.5 * std::cos(1.0), 1e-5);
  EXPECT_NEAR(circle.points.back().z, 0.5 * std::sin(1.0), 1e-5);
  EXPECT_EQ(circle.points.back().y, 3.0);
  const auto pipe = MakeSteady({{GridAxis(), axis, GridAxis()}, {}}, [](const Vec3& p) {
    return Vec3{0.0, 2.0 + p.y, 0.0};
  });
  const FlowLine along = TraceOne(*pipe, {0.0, -1.0, 0.0});
  EXPECT_EQ(along.downstream_end, LineEnd::kLeft);
  EXPECT_NEAR(along.times_s.back(), std::log(3.0), 1e-6);
}

TEST(LineIntegrator, FlowsTheSameInCurvilinearCells) {
  // A sheared and curved grid; the field is linear in x and y, so bilinear cells are not exact.
  const auto place = [](double a, double b) {
    return Vec3{a + 0.15 * std::sin(2.0 * b), b + 0.2 * a * a, 0.0};
  };
  constexpr int kCount = 81;
  std::vector<Vec3> positions;
  for (int j = 0; j < kCount; ++j) {
    for (int i = 0; i < kCount; ++i) {
      positions.push_back(place(-1.0 + 2.0 * i / (kCount - 1), -1.0 + 2.0 * j / (kCount - 1)));
    }
  }
  const GridAxis axis(0.0, 1.0, kCount);
  StructuredGrid grid{{axis, axis, GridAxis()},
                      *CurvilinearCells::Create({kCount, kCount, 1}, positions)};
  const auto field = MakeSteady(grid, SolidRotation);
  const FlowLine line = TraceOne(*field, {0.4, 0.2, 0.0}, {.direction = LineDirection::kForward});
  EXPECT_EQ(line.downstream_end, LineEnd::kClosed);
  for (const Vec3& p : line.points) EXPECT_NEAR(std::hypot(p.x, p.y), std::hypot(0.4, 0.2), 1e-4);
  // It leaves where the grid ends.
  const auto wind = MakeSteady(grid, [](const Vec3&) { return Vec3{1.0, 0.0, 0.0}; });
  const FlowLine out = TraceOne(*wind, {0.0, 0.0, 0.0});
  EXPECT_EQ(out.downstream_end, LineEnd::kLeft);
  EXPECT_NEAR(out.points.back().x, place(1.0, -0.2).x, 2e-3);
}

TEST(LineIntegrator, GivesTheSameLinesForAnyNumberOfThreads) {
  const auto field = MakeSteady(Square(65, 1.0), Rankine);
  std::vector<Seed> seeds;
  for (int i = 0; i < 50; ++i) seeds.push_back({{0.018 * i - 0.4, 0.01 * i - 0.3, 0.0}});
  const auto one = Trace(*field, seeds, {.threads = 1}), two = Trace(*field, seeds, {.threads = 2});
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].points, two[i].points);
    EXPECT_EQ(one[i].field_reads, two[i].field_reads);
  }
}

// A uniform wind that turns once in `period`, read at 1/64 of a turn. Between these times it is
// linear, so its integral over whole intervals is the trapezoidal rule: chords of a circle that is
// smaller by (π/64) cot(π/64). That is the sampling's own error, 8.0e-4 of the radius.
class TurningWind : public ::testing::Test {
 protected:
  static constexpr double kSpeed = 2.0, kPeriod = 3.0;
  static constexpr double kRate = kTurn / kPeriod;
  static Vec3 At(Seconds t) {
    return {kSpeed * std::cos(kRate * t), kSpeed * std::sin(kRate * t), 0.0};
  }
  static std::shared_ptr<const GridField> Field() {
    std::vector<Seconds> times;
    for (int i = 0; i <= 128; ++i) times.push_back(kPeriod * i / 64.0);
    return MakeField(
        Square(41, 3.0), times, [](const Vec3&, Seconds t) { return At(t); },
        Interpolation::kLinear);
  }
  static constexpr double kRadius = kSpeed / kRate;
  /// Displacement of a particle from time a to time b.
  static Vec3 Way(Seconds a, Seconds b) {
    return {kRadius * (std::sin(kRate * b) - std::sin(kRate * a)),
            -kRadius * (std::cos(kRate * b) - std::cos(kRate * a)), 0.0};
  }
};

TEST_F(TurningWind, MakesPathlinesCircles) {
  const auto field = Field();
  const FlowLine line =
      TraceOne(*field, {0.1, -0.2, 0.0}, {.kind = LineKind::kPath, .step_s = kPeriod / 64.0});
  EXPECT_EQ(line.downstream_end, LineEnd::kDuration);
  EXPECT_NEAR(line.times_s.back(), 2.0 * kPeriod, 1e-12);
  // The integral of a linear interpolant is the trapezoidal rule: at the times of the file its
  // chords are those of a circle whose radius is smaller by (π/64) cot(π/64).
  const double x = std::numbers::pi / 64.0;
  const double shrink = x / std::tan(x);
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const Vec3 exact = Vec3{0.1, -0.2, 0.0} + Way(0.0, line.times_s[i]) * shrink;
    EXPECT_LE(Norm(line.points[i] - exact), 1e-3 * kRadius) << i;
    EXPECT_LE(Norm(line.points[i] - exact), 1e-6 * kRadius) << i;
  }
}

TEST_F(TurningWind, MakesStreamlinesStraight) {
  const auto field = Field();
  const Seconds moment = kPeriod * 5.0 / 64.0;
  const FlowLine line = TraceOne(*field, {0.0, 0.0, 0.0}, {.frozen_at_s = moment});
  EXPECT_EQ(line.downstream_end, LineEnd::kLeft);
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    EXPECT_NEAR(Norm(line.points[i] - At(moment) * line.times_s[i]), 0.0, 1e-9);
  }
}

TEST_F(TurningWind, MakesStreaklinesAsInClosedForm) {
  const auto field = Field();
  const Vec3 seed{0.3, 0.1, 0.0};
  const FlowLine line = TraceOne(
      *field, seed,
      {.kind = LineKind::kStreak, .duration_s = 0.75 * kPeriod, .step_s = kPeriod / 128.0});
  ASSERT_THAT(line.points, SizeIs(97));
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const Vec3 exact = seed + Way(line.times_s[i], 0.75 * kPeriod);
    EXPECT_LE(Norm(line.points[i] - exact), (1e-3 + 8.04e-4) * kRadius * 2.0) << i;
  }
  EXPECT_EQ(line.points.front(), seed);
}

TEST_F(TurningWind, TakesPathlinesBackToTheirSeeds) {
  const auto field = Field();
  const FlowLine there =
      TraceOne(*field, {0.1, -0.2, 0.0}, {.kind = LineKind::kPath, .duration_s = 0.6 * kPeriod});
  auto back = Trace(*field, {{there.points.back(), there.times_s.back()}},
                    {.kind = LineKind::kPath, .direction = LineDirection::kBackward});
  ASSERT_THAT(back, SizeIs(1));
  EXPECT_NEAR(back[0].times_s.back(), 0.0, 1e-12);
  EXPECT_LE(Norm(back[0].points.back() - Vec3{0.1, -0.2, 0.0}), 1e-6);
}

TEST(LineIntegrator, TakesFieldsThatAreNoGrid) {
  const FormulaField field([](const Vec3& p, Seconds) { return SolidRotation(p); }, {});
  const FlowLine line = TraceOne(field, {0.5, 0.0, 0.0});
  EXPECT_EQ(line.downstream_end, LineEnd::kClosed);
  for (const Vec3& p : line.points) EXPECT_NEAR(std::hypot(p.x, p.y), 0.5, 1e-5);
  const FormulaField changing(
      [](const Vec3&, Seconds t) {
        return Vec3{0.1 * t, 0.0, 0.0};
      },
      {0.0, 4.0});
  const FlowLine path = TraceOne(changing, {0.0, 0.0, 0.0}, {.kind = LineKind::kPath});
  EXPECT_EQ(path.downstream_end, LineEnd::kDuration);
  EXPECT_NEAR(path.points.back().x, 0.8, 1e-9);
}

TEST(LineIntegrator, ReportsAReadThatFailed) {
  const auto field = GridField::Create(Square(9, 1.0), {}, [](std::size_t) -> Result<FieldSlice> {
    return InputError("wind.nc", "is cut short");
  });
  const auto lines = TraceLines(**field, std::vector<Seed>{{{0.0, 0.0, 0.0}}}, {});
  ASSERT_FALSE(lines);
  EXPECT_EQ(lines.error().where, "wind.nc");
}

TEST(LineIntegrator, NeedsAnEndForStreaklinesOfASteadyField) {
  const auto field = MakeSteady(Square(9, 1.0), SolidRotation);
  EXPECT_FALSE(
      TraceLines(*field, std::vector<Seed>{{{0.1, 0.0, 0.0}}}, {.kind = LineKind::kStreak}));
}

}  // namespace
}  // namespace pleinair::content
