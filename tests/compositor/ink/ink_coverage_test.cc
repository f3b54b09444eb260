// The closed forms of shaders/ink_coverage.glsl against the mean of many places in the footprint,
// and the cells of InkGrid against all shapes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <numbers>
#include <random>
#include <vector>

#include "compositor/ink/ink_grid.h"
#include "gl/glsl_as_cpp.h"

namespace glsl {
using namespace glm;  // NOLINT(google-build-using-namespace): as GLSL has it.
#include "compositor/shaders/ink_coverage.glsl"
}  // namespace glsl

namespace pleinair::compositor {
namespace {

struct Footprint {
  glm::vec2 center, x, y;

  glsl::InkFootprint Seen() const {
    return {glm::vec3(center, 0.0F), x, y, 0.0F, {0.0F, 0.0F}, false};
  }

  template <typename Inside>
  double Mean(const Inside& inside) const {
    constexpr int kSide = 64;
    double sum = 0.0;
    for (int i = 0; i < kSide * kSide; ++i) {
      const int column = i % kSide, row = i / kSide;
      const float u = (static_cast<float>(column) + 0.5F) / kSide - 0.5F;
      const float v = (static_cast<float>(row) + 0.5F) / kSide - 0.5F;
      sum += inside(center + u * x + v * y) ? 1.0 : 0.0;
    }
    return sum / (kSide * kSide);
  }
  float Reach() const { return 0.5F * (glm::length(x) + glm::length(y)); }
};

double Distance(glm::vec2 at, glm::vec2 from, glm::vec2 to) {
  const glm::vec2 whole = to - from;
  const float share = glm::clamp(glm::dot(at - from, whole) / glm::dot(whole, whole), 0.0F, 1.0F);
  return glm::length(at - from - share * whole);
}

float LineCoverage(const Footprint& seen, const std::vector<glm::vec2>& line, float half_width,
                   float dash = 0.0F, float gap = 0.0F) {
  float way = 0.0F;
  glsl::LineCoverage covered = glsl::NoCoverage();
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const float size = glm::length(line[i + 1] - line[i]);
    covered = glsl::WithSegment(
        covered,
        glsl::CoverageOfSegment(seen.Seen(), glm::vec4(line[i], 0.0F, way),
                                glm::vec4(line[i + 1], 0.0F, 0.0F), {half_width, dash, gap}));
    way += size;
  }
  return glsl::CoverageOfLine(covered, half_width, seen.Reach());
}

float AreaCoverage(const Footprint& seen, const std::vector<glm::vec2>& ring, glm::vec2 outside) {
  float inside = 0.0F, beyond = 0.0F;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    inside += glsl::CrossingOfEdge(outside, seen.center, ring[i], ring[i + 1]);
    beyond += glsl::CoverageBeyondEdge(seen.center, seen.x, seen.y, ring[i], ring[i + 1]);
  }
  return std::clamp(inside + beyond, 0.0F, 1.0F);
}

bool IsInside(glm::vec2 at, const std::vector<glm::vec2>& ring) {
  bool inside = false;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    const glm::vec2 a = ring[i], b = ring[i + 1];
    if ((a.y <= at.y) == (b.y <= at.y)) continue;
    if (a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x) > at.x) inside = !inside;
  }
  return inside;
}

class InkCoverage : public testing::Test {
 protected:
  float Uniform(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random_);
  }
  /// A footprint like that of a pixel on level ground.
  Footprint Pixel(float size_m, float lengthening) {
    const float turn = Uniform(0.0F, 2.0F * std::numbers::pi_v<float>);
    const glm::vec2 along(std::cos(turn), std::sin(turn)), across(-along.y, along.x);
    return {{Uniform(-0.5F, 0.5F), Uniform(-0.5F, 0.5F)},
            size_m * lengthening * along,
            size_m * across};
  }
  std::mt19937 random_{20251114};
};

TEST_F(InkCoverage, OfAStraightLineOfAnyWidth) {
  double squares = 0.0;
  int count = 0;
  for (const float width : {0.02F, 0.1F, 0.5F, 2.0F}) {
    for (int i = 0; i < 200; ++i) {
      const Footprint pixel = Pixel(0.1F, Uniform(1.0F, 8.0F));
      const std::vector<glm::vec2> line{{-9, Uniform(-0.3F, 0.3F)}, {9, Uniform(-0.3F, 0.3F)}};
      const double truth =
          pixel.Mean([&](glm::vec2 at) { return Distance(at, line[0], line[1]) < 0.5 * width; });
      const double error = LineCoverage(pixel, line, 0.5F * width) - truth;
      EXPECT_LT(std::fabs(error), 0.16) << width;  // A box in place of a slanting parallelogram.
      squares += error * error;
      ++count;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 0.03);
}

TEST_F(InkCoverage, DoesNotDependOnHowALineIsDivided) {
  for (const float width : {0.01F, 0.05F, 0.3F}) {
    for (int i = 0; i < 100; ++i) {
      const Footprint pixel = Pixel(0.1F, 3.0F);
      const std::vector<glm::vec2> whole{{-2, -0.1F}, {2, 0.2F}};
      std::vector<glm::vec2> divided;
      for (int k = 0; k <= 400; ++k) {
        divided.push_back(whole[0] + static_cast<float>(k) / 400.0F * (whole[1] - whole[0]));
      }
      EXPECT_NEAR(LineCoverage(pixel, divided, 0.5F * width),
                  LineCoverage(pixel, whole, 0.5F * width), 0.01)
          << width;
    }
  }
}

TEST_F(InkCoverage, KeepsTheInkOfShortAndBentLines) {
  // Over a raster of pixels, the sum is the area of the line.
  for (const float width : {0.02F, 0.06F}) {
    const std::vector<glm::vec2> line{{0.03F, 0.02F}, {0.51F, 0.33F}, {0.62F, 0.71F}};
    double sum = 0.0;
    for (int y = -10; y < 20; ++y) {
      for (int x = -10; x < 20; ++x) {
        const Footprint pixel{{0.1F * static_cast<float>(x), 0.1F * static_cast<float>(y)},
                              {0.1F, 0.0F},
                              {0.0F, 0.1F}};
        sum += LineCoverage(pixel, line, 0.5F * width);
      }
    }
    const double area = width * (glm::length(line[1] - line[0]) + glm::length(line[2] - line[1]));
    EXPECT_NEAR(sum * 0.01, area, 0.06 * area) << width;
  }
}

TEST_F(InkCoverage, OfDashesIsTheirShareFromAfar) {
  const std::vector<glm::vec2> line{{-50, 0}, {50, 0}};
  const Footprint near{{0.25F, 0.0F}, {0.01F, 0.0F}, {0.0F, 0.01F}};
  // Dashes of 1 m and gaps of 0.5 m, from −50 on: one begins at −0.5.
  EXPECT_NEAR(LineCoverage(near, line, 0.1F, 1.0F, 0.5F), 1.0, 1e-3);
  const Footprint gap{{0.75F, 0.0F}, {0.01F, 0.0F}, {0.0F, 0.01F}};
  EXPECT_NEAR(LineCoverage(gap, line, 0.1F, 1.0F, 0.5F), 0.0, 1e-3);
  const Footprint end{{0.5F, 0.0F}, {0.01F, 0.0F}, {0.0F, 0.01F}};
  EXPECT_NEAR(LineCoverage(end, line, 0.1F, 1.0F, 0.5F), 0.5, 0.01);
  const Footprint far{{0.3F, 0.0F}, {15.0F, 0.0F}, {0.0F, 0.01F}};
  EXPECT_NEAR(LineCoverage(far, line, 20.0F, 1.0F, 0.5F), 2.0 / 3.0, 0.01);
}

TEST_F(InkCoverage, OfAnAreaAlsoIfItIsThin) {
  double squares = 0.0;
  int count = 0;
  for (int i = 0; i < 1000; ++i) {
    // A quadrilateral, from slivers to squares.
    const float turn = Uniform(0.0F, 2.0F * std::numbers::pi_v<float>);
    const glm::vec2 along(std::cos(turn), std::sin(turn)), across(-along.y, along.x);
    const float width = std::exp(Uniform(std::log(0.01F), std::log(1.0F)));
    const std::vector<glm::vec2> ring{-along - 0.5F * width * across, along - 0.5F * width * across,
                                      along + 0.5F * width * across, -along + 0.5F * width * across,
                                      -along - 0.5F * width * across};
    const Footprint pixel = Pixel(0.1F, Uniform(1.0F, 4.0F));
    const double truth = pixel.Mean([&](glm::vec2 at) { return IsInside(at, ring); });
    const double error = AreaCoverage(pixel, ring, {7.0F, 5.0F}) - truth;
    EXPECT_LT(std::fabs(error), 0.3);  // At corners.
    squares += error * error;
    ++count;
  }
  EXPECT_LT(std::sqrt(squares / count), 0.03);
}

TEST_F(InkCoverage, IsNotOnASurfaceAboveTheLine) {
  const auto covered = [](float height_m) {
    return glsl::CoverageOfSegment({glm::vec3(0.0F, 0.01F, height_m),
                                    {0.01F, 0.0F},
                                    {0.0F, 0.01F},
                                    0.0F,
                                    {0.0F, 0.0F},
                                    false},
                                   {-1, 0, 0, 0}, {1, 0, 0, 0}, {0.1F, 0.0F, 0.0F})
        .round_capped;
  };
  EXPECT_EQ(covered(0.0F), 1.0F);
  EXPECT_EQ(covered(0.7F), 0.0F);
  EXPECT_EQ(covered(-0.7F), 0.0F);
}

TEST_F(InkCoverage, OfALineUpAWallIsABandOfItsWidth) {
  // A line up a wall along x, to 2 m. Pixels of 5 mm.
  const auto covered = [](float x, float z, float half_width) {
    const auto line = glsl::WithSegment(
        glsl::NoCoverage(),
        glsl::CoverageOfSegment(
            {glm::vec3(x, 0.0F, z), {0.005F, 0.0F}, {0.0F, 0.0F}, 0.005F, {0.0F, 0.0F}, true},
            {0, 0, 0, 0}, {0, 0, 2, 0}, {half_width, 0.0F, 0.0F}));
    return glsl::CoverageOfLine(line, half_width, 0.0025F);
  };
  EXPECT_NEAR(covered(0.05F, 1.0F, 0.1F), 1.0F, 1e-4F);
  EXPECT_NEAR(covered(0.1F, 1.0F, 0.1F), 0.5F, 1e-3F);
  EXPECT_EQ(covered(0.15F, 1.0F, 0.1F), 0.0F);
  EXPECT_NEAR(covered(0.0F, 2.0F, 0.1F), 0.5F, 1e-3F) << "at the upper end";
  EXPECT_EQ(covered(0.0F, 2.7F, 0.1F), 0.0F);
  EXPECT_NEAR(covered(0.0F, 1.0F, 0.0005F), 0.2F, 1e-3F) << "thinner than a pixel";
}

TEST_F(InkCoverage, OfALineUpAWallIsNotOnTheGroundBeforeIt) {
  for (const float y : {0.0F, -0.05F, -1.0F}) {
    const auto line = glsl::CoverageOfSegment(
        {glm::vec3(0.0F, y, 0.0F), {0.005F, 0.0F}, {0.0F, 0.005F}, 0.0F, {0.0F, 0.0F}, false},
        {0, 0, 0, 0}, {0, 0, 2, 0}, {0.1F, 0.0F, 0.0F});
    EXPECT_EQ(line.round_capped + line.flat_capped, 0.0F) << y;
  }
}

TEST_F(InkCoverage, OfADiscIsItsArea) {
  for (const float radius : {0.01F, 0.03F, 0.4F}) {
    double sum = 0.0;
    for (int y = -10; y <= 10; ++y) {
      for (int x = -10; x <= 10; ++x) {
        const auto line = glsl::WithSegment(
            glsl::NoCoverage(),
            glsl::CoverageOfSegment(
                {glm::vec3(0.1F * static_cast<float>(x), 0.1F * static_cast<float>(y), 0.0F),
                 {0.1F, 0.0F},
                 {0.0F, 0.1F},
                 0.0F,
                 {0.0F, 0.0F},
                 false},
                {0.013F, 0.021F, 0, 0}, {0.013F, 0.021F, 0, 0}, {radius, 0.0F, 0.0F}));
        sum += glsl::CoverageOfLine(line, radius, 0.1F);
      }
    }
    const double area = std::numbers::pi * radius * radius;
    EXPECT_NEAR(sum * 0.01, area, 0.06 * area) << radius;
  }
}

/// Coverage of a shape by the cells of a grid, as shaders/ink.frag finds it; −1 in a cell of means.
float ByCells(const InkGrid& grid, std::uint32_t shape, const InkShape& of, const Footprint& seen) {
  const float needed = 2.0F * seen.Reach() / grid.levels().front().cell_m;
  const auto wanted = static_cast<std::size_t>(std::ceil(std::log2(std::max(needed, 1.0F))));
  const InkGrid::Level& level = grid.levels()[std::min(wanted, grid.levels().size() - 1)];
  const glm::vec2 cell = glm::clamp(glm::floor((seen.center - grid.origin_m()) / level.cell_m),
                                    glm::vec2(0.0F), glm::vec2(level.cells - 1));
  const glm::vec2 center = grid.origin_m() + level.cell_m * (cell + 0.5F);
  const auto [first, count] =
      grid.cells()[level.first_cell +
                   static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(level.cells.x) +
                   static_cast<std::size_t>(cell.x)];
  for (std::uint32_t e = first; e < first + count; ++e) {
    const InkGrid::Entry& entry = grid.entries()[e];
    if ((entry.count & InkGrid::kMeanBit) != 0) return -1.0F;
    if (entry.shape != shape) continue;
    float inside = entry.inside;
    glsl::LineCoverage line = glsl::NoCoverage();
    for (std::uint32_t p = entry.first_part; p < entry.first_part + entry.count; ++p) {
      const InkPart& part = grid.segments()[grid.parts()[p]];
      inside +=
          glsl::CrossingOfEdge(center, seen.center, glm::vec2(part.from), glm::vec2(part.to)) +
          glsl::CoverageBeyondEdge(seen.center, seen.x, seen.y, glm::vec2(part.from),
                                   glm::vec2(part.to));
      line = glsl::WithSegment(line, glsl::CoverageOfSegment(seen.Seen(), part.from, part.to,
                                                             {0.5F * of.pen.width_m, 0.0F, 0.0F}));
    }
    return of.rings.empty() ? glsl::CoverageOfLine(line, 0.5F * of.pen.width_m, seen.Reach())
                            : std::clamp(inside, 0.0F, 1.0F);
  }
  return 0.0F;
}

TEST_F(InkCoverage, ByCellsIsThatByAllParts) {
  std::vector<InkShape> shapes;
  for (int i = 0; i < 30; ++i) {
    InkShape shape;
    const glm::vec2 center(Uniform(-20.0F, 20.0F), Uniform(-20.0F, 20.0F));
    std::vector<glm::vec2> points;
    for (int k = 0; k <= 24; ++k) {
      const float turn = static_cast<float>(k % 24) / 12.0F * std::numbers::pi_v<float>;
      points.push_back(center +
                       (k % 2 == 0 ? 4.0F : 2.5F) * glm::vec2(std::cos(turn), std::sin(turn)));
    }
    if (i % 2 == 0) {
      shape.rings = {points};
    } else {
      shape.pen.width_m = Uniform(0.05F, 1.5F);
      for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        shape.segments.push_back({glm::vec3(points[k], 0.0F), glm::vec3(points[k + 1], 0.0F)});
      }
    }
    shapes.push_back(shape);
  }
  const InkGrid grid(shapes);
  int compared = 0;
  for (int i = 0; i < 4000; ++i) {
    const float size_m = std::exp(Uniform(std::log(0.005F), std::log(2.0F)));
    Footprint pixel = Pixel(size_m, Uniform(1.0F, 5.0F));
    pixel.center = {Uniform(-26.0F, 26.0F), Uniform(-26.0F, 26.0F)};
    for (std::uint32_t s = 0; s < shapes.size(); ++s) {
      const float by_cells = ByCells(grid, s, shapes[s], pixel);
      if (by_cells < 0.0F) continue;
      std::vector<glm::vec2> points;
      if (shapes[s].rings.empty()) {
        for (const InkSegment& segment : shapes[s].segments) points.emplace_back(segment.from_m);
        points.emplace_back(shapes[s].segments.back().to_m);
      }
      const float by_all = shapes[s].rings.empty()
                               ? LineCoverage(pixel, points, 0.5F * shapes[s].pen.width_m)
                               : AreaCoverage(pixel, shapes[s].rings[0], {99.0F, 71.3F});
      EXPECT_NEAR(by_cells, by_all, 2e-3) << s << ", footprint " << size_m;
      compared += by_all > 0.0F ? 1 : 0;
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST_F(InkCoverage, OfCrowdedCellsIsTheMean) {
  // A hundred parallel lines of 0.1 m, 0.5 m apart.
  InkShape shape;
  shape.pen.width_m = 0.1F;
  for (int i = 0; i < 100; ++i) {
    const float y = 0.5F * static_cast<float>(i);
    for (int k = 0; k < 50; ++k) {
      shape.segments.push_back(
          {{static_cast<float>(k), y, 0.0F}, {static_cast<float>(k + 1), y, 0.0F}});
    }
  }
  const InkGrid grid(std::vector<InkShape>{shape});
  int means = 0;
  for (const InkGrid::Level& level : grid.levels()) {
    if (level.cell_m > 12.0F) continue;  // Cells that reach beyond the lines.
    const int middle = level.cells.y / 2 * level.cells.x + level.cells.x / 2;
    const auto [first, count] = grid.cells()[level.first_cell + static_cast<std::size_t>(middle)];
    for (std::uint32_t e = first; e < first + count; ++e) {
      const InkGrid::Entry& entry = grid.entries()[e];
      EXPECT_LE(entry.count & ~InkGrid::kMeanBit, InkGrid::kMaxParts);
      if ((entry.count & InkGrid::kMeanBit) == 0) continue;
      EXPECT_NEAR(entry.inside, 0.2, 0.05) << level.cell_m;
      ++means;
    }
  }
  EXPECT_GT(means, 1);
}

}  // namespace
}  // namespace pleinair::compositor
